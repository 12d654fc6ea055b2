// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/planes.h"

#include <vector>

#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kCoarsest = GLOAM_SHADOW_PLANE_BLOCK
                                    << (GLOAM_SHADOW_PLANE_LEVELS - 1);  // texels of a block's side, last level

gpu::ComputePipelineDesc planes_pipeline() { return {"shadow_planes", "shadows", shaders::shadows::planes_comp, {}}; }

std::vector<FacePart> parts_of(const ShadowMaps& maps, const ShadowViews& views, bool all) {
  if (!all) return maps.drawn;
  std::vector<FacePart> parts;
  for (const ShadowFace& face : views.faces)
    if (face.square.size > 0) parts.push_back({face.square, whole_face(face)});
  return parts;
}

/// Joins adjacent parts of one face into one.
std::vector<FacePart> joined_by_face(std::span<const FacePart> parts) {
  std::vector<FacePart> joined;
  for (const FacePart& part : parts) {
    if (joined.empty() || joined.back().square != part.square) {
      joined.push_back(part);
      continue;
    }
    TexelRect& texels = joined.back().texels;
    texels = {glm::min(texels.begin, part.texels.begin), glm::max(texels.end, part.texels.end)};
  }
  return joined;
}

/// The dispatches of planes.comp: level 0, then the other levels.
struct PlaneWork {
  std::vector<shaders::ShadowPlaneGroup> groups;
  GroupRange ranges[2];

  /// block: texels of mip 0 per side of the area that one thread processes.
  [[nodiscard]] GroupRange add(std::span<const FacePart> parts, std::uint32_t block) {
    GroupRange range{static_cast<std::uint32_t>(groups.size()), 0};
    for (const FacePart& part : parts)
      add_groups(part.texels.begin / block, (part.texels.end + block - 1u) / block, GLOAM_SHADOW_PLANE_GROUP,
                 [&](uvec2 begin, uvec2 end) {
                   groups.push_back({part.square.origin, begin, end, part.square.size});
                 });
    range.count = static_cast<std::uint32_t>(groups.size()) - range.first;
    return range;
  }
};

PlaneWork work_of(std::span<const FacePart> parts) {
  PlaneWork work;
  work.ranges[0] = work.add(parts, GLOAM_SHADOW_PLANE_BLOCK);
  work.ranges[1] = work.add(joined_by_face(parts), kCoarsest);  // joined, so that none of the few texels is made twice
  return work;
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
  const std::vector<FacePart> parts = parts_of(maps, views, all);
  if (parts.empty()) return planes;
  const PlaneWork work = work_of(parts);
  auto groups = frame.services().storage.write(std::as_bytes(std::span(work.groups)));
  if (!groups.ok()) return groups.error();
  auto pipeline = frame.services().pipelines.get(planes_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  PassBuilder pass = frame.graph().add_pass("shadow_planes", "shadows");
  pass.read(maps.atlas, gpu::Access::compute_read);
  planes = pass.write(planes, gpu::Access::compute_write);
  pass.execute([&kept, first = work.ranges[0], others = work.ranges[1], groups = *groups, atlas = maps.atlas, planes,
                pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(atlas)}, sampler}},
                                     {1, gpu::Binding::Storage{{.image = context.image(planes)}}},
                                     {2, groups}};
    commands.bind(bindings);
    dispatch_groups(commands, shaders::ShadowPlaneConstants{0, kept.atlas_size, 0}, first);
    const gpu::ImageBarrier written[] = {
        {context.image(planes), gpu::Access::compute_write, gpu::Access::compute_write}};
    commands.barrier({}, written);
    dispatch_groups(commands, shaders::ShadowPlaneConstants{1, kept.atlas_size, 0}, others);
    kept.planes.filled = true;  // set here: a frame that ends before has made none
  });
  return planes;
}

}  // namespace gloam
