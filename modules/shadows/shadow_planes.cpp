// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/shadow_planes.h"

#include <utility>
#include <vector>

#include "shaders/shadows/shaders.h"
#include "shaders/shadows/shadow_planes_shared.h"

namespace gloam {
namespace {

constexpr std::uint32_t kGroup = 8;  // threads along a side of a workgroup
constexpr std::uint32_t kCoarsest = GLOAM_SHADOW_PLANE_BLOCK
                                    << (GLOAM_SHADOW_PLANE_LEVELS - 1);  // texels of a block of the last level

gpu::ComputePipelineDesc planes_pipeline() {
  return {"shadow_planes", "shadows", shaders::shadows::shadow_planes_comp, {}};
}

std::vector<FacePart> parts_of(const ShadowMaps& maps, const ShadowViews& views, bool all) {
  if (!all) return maps.drawn;
  std::vector<FacePart> parts;
  for (const ShadowFace& face : views.faces)
    if (face.square.size > 0) parts.push_back({face.square, whole_face(face)});
  return parts;
}

/// One dispatch a part. `level`: the first that is made.
void record_parts(gpu::CommandList& commands, std::span<const FacePart> parts, std::uint32_t level,
                  std::uint32_t atlas_size) {
  const std::uint32_t block = level == 0 ? GLOAM_SHADOW_PLANE_BLOCK : kCoarsest;
  for (const FacePart& part : parts) {
    const uvec2 first = part.texels.begin / block, end = (part.texels.end + block - 1u) / block;
    shaders::ShadowPlaneConstants constants{};
    constants.origin = part.square.origin;
    constants.first = first * block;
    constants.texels = (end - first) * block;
    constants.first_level = level;
    constants.atlas_size = atlas_size;
    constants.face_size = part.square.size;
    commands.push(constants);
    const uvec2 groups = (end - first + (kGroup - 1u)) / kGroup;
    commands.dispatch(groups.x, groups.y, 1);
  }
}

}  // namespace

void list_shadow_plane_pipelines(PipelineList& list) { list.push_back(planes_pipeline()); }

Result<ImageRef> add_shadow_planes_pass(FrameBuilder& frame, ShadowStates& states, ViewShadows& kept,
                                        const ShadowMaps& maps, const ShadowViews& views) {
  GLOAM_TRY(states.reserve_planes(kept));
  const bool all = !kept.planes.filled;
  ImageRef planes =
      frame.graph().import_image("shadow_planes", kept.planes.image,
                                 all ? gpu::Access::none : gpu::Access::fragment_read, gpu::Access::fragment_read);
  std::vector<FacePart> parts = parts_of(maps, views, all);
  if (parts.empty()) return planes;
  auto pipeline = frame.services().pipelines.get(planes_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  PassBuilder pass = frame.graph().add_pass("shadow_planes", "shadows");
  pass.read(maps.atlas, gpu::Access::compute_read);
  planes = pass.write(planes, gpu::Access::compute_write);
  pass.execute([&kept, parts = std::move(parts), atlas = maps.atlas, planes, pipeline = *pipeline,
                sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(atlas)}, sampler}},
                                     {1, gpu::Binding::Storage{{.image = context.image(planes)}}}};
    commands.bind(bindings);
    record_parts(commands, parts, 0, kept.atlas_size);
    const gpu::ImageBarrier written[] = {
        {context.image(planes), gpu::Access::compute_write, gpu::Access::compute_write}};
    commands.barrier({}, written);
    record_parts(commands, parts, 1, kept.atlas_size);
    kept.planes.filled = true;  // only now: a frame that ended before has made none
  });
  return planes;
}

}  // namespace gloam
