// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/culling_passes.h"

#include <algorithm>
#include <any>
#include <array>
#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/draws/culling.h"
#include "engine/render/draws/occluders.h"
#include "engine/render/settled_result.h"
#include "shaders/render/culling/culling_shared.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

/// Views of fewer triangles are drawn faster without a search.
constexpr std::uint32_t kFewestTriangles = 131072;
/// Where less than one in this many triangles was hidden, the search costs more than it saves. It is tried again in one
/// of kTrialFrames frames, and after a camera cut.
constexpr std::uint32_t kLeastHiddenShare = 8;
constexpr std::uint64_t kTrialFrames = 32;
/// One in this many of a view's triangles may be drawn twice, as an occluder; kLeastOccluders, if
/// that is more.
constexpr std::uint32_t kOccluderShare = 16;
constexpr std::uint32_t kLeastOccluders = 2048;

/// The frame's occluders, which live until it is recorded.
struct OccluderDraws {
  std::vector<Draw> draws;
};

using DepthLevels = std::array<ImageRef, GLOAM_CULLING_LEVELS>;

SurfacePass occluder_surface_pass(bool motion) {
  // The vertex shader of the geometry pass: both must give the same depth.
  return {.module = "engine", .fragment = {}, .color_formats = {}, .motion = motion};
}

ImageRef add_occluder_pass(FrameBuilder& frame) {
  const std::uint32_t triangles = solid_triangles(frame.draws());
  const std::uint32_t most = std::max(triangles / kOccluderShare, kLeastOccluders);
  const OccluderDraws& occluders = frame.put(OccluderDraws{choose_occluders(frame.view(), frame.draws(), most)});
  DrawPass pass(frame, "occluders");
  const ImageRef depth =
      pass.depth_target(create_view_image(frame, "depth", gpu::Format::d32_float), gpu::LoadOp::clear);
  pass.use(occluder_surface_pass(frame.previous_instances() != nullptr));
  bind_motion(pass, frame.view());
  pass.surfaces(occluders.draws);
  return depth;
}

DepthLevels add_level_passes(FrameBuilder& frame, ImageRef depth) {
  DepthLevels levels;
  uvec2 size = (uvec2(frame.view().width, frame.view().height) + (GLOAM_CULLING_TEXEL - 1u)) / GLOAM_CULLING_TEXEL;
  size = {std::bit_ceil(size.x), std::bit_ceil(size.y)};
  for (std::size_t level = 0; level < levels.size(); ++level) {
    gpu::ImageDesc desc;
    desc.name = "occluder_depth_" + std::to_string(level);
    desc.module = frame.module();
    desc.format = gpu::Format::r32_float;
    desc.width = size.x;
    desc.height = size.y;
    const ImageRef image = frame.graph().create_image(std::move(desc));
    ComputePass pass(frame, "occluder_depth",
                     level == 0 ? shaders::render::farthest_depth_comp : shaders::render::halve_depth_comp);
    pass.read(level == 0 ? "depth_image" : "finer_image", level == 0 ? depth : levels[level - 1]);
    levels[level] = pass.write(level == 0 ? "farthest_image" : "coarser_image", image);
    pass.dispatch_over(size);
    size = glm::max(size / 2u, uvec2(1));
  }
  return levels;
}

BufferRef create_buffer(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = bytes;
  return frame.graph().create_buffer(std::move(desc));
}

BufferRef zeroed_counters(FrameBuilder& frame) {
  const BufferRef buffer = create_buffer(frame, "culling_counters", sizeof(shaders::CullingCounters));
  PassBuilder pass = frame.graph().add_pass("culling_start", frame.module());
  const BufferRef zeroed = pass.write(buffer, gpu::Access::transfer_write);
  pass.execute([zeroed](PassContext& context) {
    context.commands().fill_buffer(context.buffer(zeroed), 0, sizeof(shaders::CullingCounters), 0);
  });
  return zeroed;
}

/// Finds the visible clusters, and counts the others. Returns a word for each cluster: 1 if it is visible.
BufferRef add_cull_pass(FrameBuilder& frame, const DepthLevels& levels) {
  const std::vector<shaders::DrawCluster>& clusters = frame.draws().clusters;
  BufferRef counters = zeroed_counters(frame);
  BufferRef visible = create_buffer(frame, "visible_clusters", clusters.size() * sizeof(std::uint32_t));
  ComputePass pass(frame, "cull_clusters", shaders::render::cull_clusters_comp);
  pass.items<shaders::DrawCluster>("clusters", clusters);
  for (std::size_t level = 0; level < levels.size(); ++level)
    pass.read("depth_" + std::to_string(level), levels[level]);
  visible = pass.write("visible", visible);
  counters = pass.write("counters", counters);
  const auto count = static_cast<std::uint32_t>(clusters.size());
  pass.push(count);
  pass.dispatch_over(count);
  frame.keep_result("engine", std::string(kCullingResult), counters, solid_triangles(frame.draws()));
  return visible;
}

BufferRef add_merge_pass(FrameBuilder& frame, BufferRef visible) {
  const ViewDraws& draws = frame.draws();
  std::vector<std::uint32_t> starts(draws.clusters.size(), 0);
  for (const Draw& draw : draws.solid) starts[draw.first_cluster] = 1;
  BufferRef commands =
      create_buffer(frame, "cluster_commands", draws.clusters.size() * sizeof(shaders::ClusterCommand));
  ComputePass pass(frame, "merge_commands", shaders::render::merge_commands_comp);
  pass.items<shaders::DrawCluster>("clusters", draws.clusters);
  pass.items<std::uint32_t>("starts", starts);
  pass.read("visible", visible);
  commands = pass.write("commands", commands);
  const auto count = static_cast<std::uint32_t>(draws.clusters.size());
  pass.push(count);
  pass.dispatch_over(count);
  return commands;
}

/// Whether the search hid enough triangles when it was last made.
bool has_paid(const FrameBuilder& frame) {
  const FrameResult* last = settled_result(frame, "engine", kCullingResult);
  if (last == nullptr || frame.view().camera_cut() || frame.view().frame % kTrialFrames == 0) return true;
  const std::uint32_t triangles = std::any_cast<std::uint32_t>(last->note);
  return last->value<shaders::CullingCounters>().triangles >= triangles / kLeastHiddenShare;
}

}  // namespace

bool culls_hidden(const FrameBuilder& frame) {
  if (frame.view().clipped || frame.draws().clusters.empty()) return false;
  switch (frame.knobs().try_value(kCulling).value_or(Culling::automatic)) {
    case Culling::frustum:
      return false;
    case Culling::occlusion:
      return true;
    case Culling::automatic:
      return solid_triangles(frame.draws()) >= kFewestTriangles && has_paid(frame);
  }
  return false;
}

CulledView add_culling_passes(FrameBuilder& frame) {
  CulledView view;
  view.depth = add_occluder_pass(frame);
  view.commands = add_merge_pass(frame, add_cull_pass(frame, add_level_passes(frame, view.depth)));
  return view;
}

}  // namespace gloam
