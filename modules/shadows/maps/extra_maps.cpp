// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/maps/recording.h"
#include "modules/shadows/maps/tools.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/views/cascades.h"

namespace gloam {
namespace {

constexpr std::uint32_t kExtraTexels = 2048 * 2048;  // texels of the maps that one call of draw() accepts

struct ExtraWork : MapWork {
  std::vector<Caster> casters;  ///< draws point to these
};

DrawnFace drawn_face(const ExtraMap& map, std::span<const Caster> casters, std::span<const CasterSource* const> sources,
                     const CasterForm& form) {
  DrawnFace drawn{map.face, {}, {}, {}};
  DrawnRegion& region = drawn.regions.emplace_back(DrawnRegion{whole_face(map.face), {}, {}});
  const FaceVolume volume = face_volume(map.face);
  region.draws = face_draws(map.face, volume, casters, form);
  for (const FaceDraw& draw : region.draws) region.matrices.push_back(clip_from_mesh(map.face, draw));
  const std::vector<CasterState> states = source_states(sources);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (holds_caster(map.casters, sources[i]->entity) && may_see(volume, states[i].box))
      region.sources.push_back(sources[i]);
  return drawn;
}

/// The casters whose entity is in `entities` (ascending by Entity::index).
std::vector<Caster> casters_of(const FrameBuilder& frame, std::span<const Entity> entities) {
  std::vector<Caster> found;
  for (const Caster& caster : frame.casters().casters)
    if (holds_caster(entities, caster.entity)) found.push_back(caster);
  return found;
}

ShadowMipImages images_of(PassContext& context, const ExtraWork& work, const ExtraAtlas& atlas) {
  return {work.scratch->image(work.faces.plan.batches.front().size),
          context.image(atlas.atlas),
          context.image(atlas.pyramid),
          {}};
}

void add_passes(FrameBuilder& frame, const std::string& name, const std::shared_ptr<const ExtraWork>& work,
                ExtraAtlas& into) {
  PassBuilder draw = frame.graph().add_pass(name, frame.module());
  frame.read_vertices(draw);
  declare_source_reads(draw, {&work->faces});
  draw.keep();  // writes images the graph does not track: never cull
  draw.execute([&frame, work](PassContext& context) { record_draws(frame, context, *work, work->faces, 0); });
  PassBuilder mips = frame.graph().add_pass(name + "_mips", frame.module());
  into.atlas = mips.write(into.atlas, gpu::Access::compute_write);
  into.pyramid = mips.write(into.pyramid, gpu::Access::compute_write);
  mips.execute([work, into](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    work->scratch->begin_reading(commands, work->faces.plan.batches.front().size);
    const ShadowMipImages images = images_of(context, *work, into);
    record_batch_mips(commands, work->mips, 0, images);
    if (work->mips.coarse.empty()) return;
    const gpu::ImageBarrier written[] = {{images.atlas, gpu::Access::compute_write, gpu::Access::compute_write},
                                         {images.pyramid, gpu::Access::compute_write, gpu::Access::compute_write}};
    commands.barrier({}, written);
    record_coarse_mips(commands, work->mips, images);
  });
}

}  // namespace

shaders::ShadowCascade orthographic_constants(const ShadowFace& face, const dvec3& view_position) {
  return cascade_constants(face, view_position, 0.0f);
}

std::uint32_t threads_a_tile(const gpu::DeviceInfo& device) {
  // Where each barrier swaps the state of all threads of a workgroup, few threads with many pixels each are faster.
  return device.threads_in_turn ? 8 : 64;
}

ExtraAtlas ShadowMapDrawer::create(FrameBuilder& frame, std::uint32_t size) const {
  gpu::ImageDesc desc;
  desc.module = frame.module();
  desc.name = desc.module + "_atlas";
  desc.format = tools_->knobs.d16 ? gpu::Format::r16_unorm : gpu::Format::r32_float;
  desc.width = size_with_mips(size).x;
  desc.height = size_with_mips(size).y;
  ExtraAtlas made;
  made.size = size;
  made.atlas = frame.graph().create_image(desc);
  desc.name = desc.module + "_pyramid";
  desc.format = gpu::Format::r32_float;
  const std::uint32_t side = size >> GLOAM_SHADOW_PYRAMID_MIP;
  desc.width = size_with_mips(side).x;
  desc.height = 2 * size_with_mips(side).y;  // nearest depths above farthest ones
  made.pyramid = frame.graph().create_image(desc);
  return made;
}

std::size_t ShadowMapDrawer::most_maps(std::uint32_t size) {
  return std::min(std::max(kExtraTexels / size / size, 1u), kMostScratchLayers);
}

void ShadowMapDrawer::draw(FrameBuilder& frame, const char* name, std::span<const ExtraMap> maps, ExtraAtlas& into,
                           MapMips mips) const {
  auto work = std::make_shared<ExtraWork>();
  std::vector<std::size_t> counts;
  for (const ExtraMap& map : maps) {
    const std::vector<Caster> casters = casters_of(frame, map.casters);
    counts.push_back(casters.size());
    work->casters.insert(work->casters.end(), casters.begin(), casters.end());
  }
  std::vector<DrawnFace> faces;
  std::span<const Caster> left = work->casters;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    faces.push_back(drawn_face(maps[i], left.first(counts[i]), frame.caster_sources(),
                               {tools_->knobs.simplified, tools_->knobs.subsurface_backs}));
    left = left.subspan(counts[i]);
  }
  work->faces = plan_faces(std::move(faces), kExtraTexels);
  GLOAM_ASSERT(work->faces.plan.batches.size() == 1, "maps of one size, few enough for one image, are drawn at a time");
  ShadowKnobs knobs = tools_->knobs;
  knobs.atlas_size = into.size;
  prepare_maps(frame, tools_->states, knobs, kSteepestSubject, *work, mips);
  add_passes(frame, std::string("shadow_map_") + name, work, into);
}

void list_bounds_pipelines(bool d16, PipelineList& list) {
  for (const MipRuns runs : {MipRuns::first, MipRuns::further})
    list.push_back(pipeline_desc(shadow_bounds_program(d16, runs), "shadows"));
}

gpu::Binding::BufferRange ShadowMapDrawer::block(FrameBuilder& frame, std::uint32_t size) const {
  shaders::ShadowBlock block = tools_->block;
  block.atlas_size = static_cast<float>(size);
  auto range = frame.services().uniforms.write_value(block);
  return frame.check(range) ? *range : gpu::Binding::BufferRange{};
}

}  // namespace gloam
