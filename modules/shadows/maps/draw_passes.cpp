// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/draw_passes.h"

#include <bit>
#include <memory>
#include <utility>
#include <vector>

#include "engine/render/worlds/world_id.h"
#include "modules/shadows/atlas/drawn_faces.h"
#include "modules/shadows/maps/images.h"
#include "modules/shadows/maps/mips.h"
#include "modules/shadows/maps/recording.h"

namespace gloam {
namespace {

struct ViewMapWork : MapWork {
  ImageRef background_image;  ///< null: the view has none
  std::vector<HeldFace> held;
};

/// Draws resting casters into the image of backgrounds, batch by batch. The frame graph does not track the scratch
/// image.
void record_backgrounds(FrameBuilder& frame, PassContext& context, const ViewMapWork& work) {
  if (work.backgrounds.faces.empty()) return;
  gpu::CommandList& commands = context.commands();
  const gpu::ImageHandle image = context.image(work.background_image);
  for (std::size_t batch = 0; batch < work.backgrounds.plan.batches.size(); ++batch) {
    record_draws(frame, context, work, work.backgrounds, batch);
    const std::uint32_t size = work.backgrounds.plan.batches[batch].size;
    work.scratch->begin_reading(commands, size);
    const gpu::ImageBarrier next{image, gpu::Access::compute_write, gpu::Access::compute_write};
    if (batch > 0) commands.barrier({}, {&next, 1});
    record_backgrounds(commands, work.mips, batch, {work.scratch->image(size), {}, {}, image});
  }
}

ShadowMipImages mip_images(PassContext& context, const ViewMapWork& work, std::size_t batch, const ShadowMaps& maps) {
  return {work.scratch->image(work.faces.plan.batches[batch].size), context.image(maps.atlas),
          context.image(maps.pyramid),
          work.background_image ? context.image(work.background_image) : gpu::ImageHandle{}};
}

/// Declares a pass shadow_map_mips, without its function.
PassBuilder add_mips_pass(FrameBuilder& frame, const ViewMapWork& work, ShadowMaps& maps) {
  PassBuilder mips = frame.graph().add_pass("shadow_map_mips", frame.module());
  if (work.background_image) mips.read(work.background_image, gpu::Access::compute_read);
  maps.atlas = mips.write(maps.atlas, gpu::Access::compute_write);
  maps.pyramid = mips.write(maps.pyramid, gpu::Access::compute_write);
  return mips;
}

/// Adds the passes that draw a batch and move it into the atlas; both are empty when `index` is beyond the plan's
/// batches. The first batch also draws the frame's backgrounds. Its pass writes their image even if there are none, so
/// that few different plans of the frame graph occur.
void add_batch(FrameBuilder& frame, const std::shared_ptr<ViewMapWork>& work, std::size_t index, ShadowMaps& maps) {
  const bool there = index < work->faces.plan.batches.size();
  PassBuilder draw = frame.graph().add_pass("shadow_map_draw", frame.module());
  frame.read_vertices(draw);
  // The same in all batches, so that few different plans of the frame graph occur.
  declare_source_reads(draw, {&work->backgrounds, &work->faces});
  draw.keep();  // writes images the graph does not track: never cull
  if (index == 0 && work->background_image)
    work->background_image = draw.write(work->background_image, gpu::Access::compute_write);
  if (there)
    draw.execute([&frame, work, index](PassContext& context) {
      if (index == 0) record_backgrounds(frame, context, *work);
      record_draws(frame, context, *work, work->faces, index);
    });
  PassBuilder mips = add_mips_pass(frame, *work, maps);
  if (!there) return;
  mips.execute([work, index, maps](PassContext& context) {
    work->scratch->begin_reading(context.commands(), work->faces.plan.batches[index].size);
    record_batch_mips(context.commands(), work->mips, index, mip_images(context, *work, index, maps));
  });
}

/// Adds the last pass; after it the atlas holds all that was drawn.
void add_coarse_mips(FrameBuilder& frame, const std::shared_ptr<ViewMapWork>& work, ShadowMaps& maps) {
  PassBuilder mips = add_mips_pass(frame, *work, maps);
  mips.execute([work, maps](PassContext& context) {
    const std::size_t last_batch = work->faces.plan.batches.size() - 1;
    record_coarse_mips(context.commands(), work->mips, mip_images(context, *work, last_batch, maps));
  });
}

/// The images of the view's maps; of backgrounds only if the view has them.
struct UsedImages {
  ShadowMaps maps;
  ImageRef backgrounds;
  bool filled = false;  ///< the cache describes their contents
};

UsedImages use_images(FrameBuilder& frame, ShadowStates& states, ViewMapState& kept, const ViewFaces& view_faces,
                      const ShadowKnobs& knobs) {
  const std::uint64_t world = world_id(frame.world());
  const std::uint64_t images = kept.takes_turns ? turn_instance(knobs) : 0;
  // What the view has left in other images says nothing about these.
  bool holds = kept.cached_images == images;
  if (kept.takes_turns) holds = states.take_turn(world, kept, knobs, frame.graph().frame()) && holds;
  frame.on_commit([&states, &kept, world, knobs, images] {
    if (kept.takes_turns) states.commit_turn(world, kept, knobs);
    kept.cached_images = images;
  });
  const HistoryImage atlas = use_map_image(frame, view_faces, knobs, kept.takes_turns, MapImage::atlas);
  const HistoryImage pyramid = use_map_image(frame, view_faces, knobs, kept.takes_turns, MapImage::pyramid);
  UsedImages used{{atlas.image, pyramid.image, {}}, {}, holds && atlas.filled() && pyramid.filled()};
  if (!used.filled || !kept.has_backgrounds) return used;
  const HistoryImage backgrounds = use_map_image(frame, view_faces, knobs, kept.takes_turns, MapImage::backgrounds);
  used.backgrounds = backgrounds.image;
  used.filled = backgrounds.filled();
  return used;
}

}  // namespace

void list_shadow_map_pipelines(const ShadowKnobs& knobs, PipelineList& list) {
  for (const MapDraw draw : {MapDraw::whole, MapDraw::fronts, MapDraw::cut_out}) list.push_back(map_pipeline(draw));
  if (knobs.subsurface_backs) list.push_back(map_pipeline(MapDraw::backs));
  for (const MipRuns runs : {MipRuns::first, MipRuns::further})
    list.push_back(pipeline_desc(shadow_mips_program(knobs, runs), "shadows"));
  list.push_back(pipeline_desc(shadow_backgrounds_program(), "shadows"));
}

ShadowMaps add_shadow_map_passes(FrameBuilder& frame, ShadowStates& states, ViewMapState& kept,
                                 const ViewFaces& view_faces, const ShadowKnobs& knobs) {
  states.choose_images(view_faces, knobs, kept);
  UsedImages used = use_images(frame, states, kept, view_faces, knobs);
  if (!frame.status().ok()) return {};
  DrawnMaps drawn = faces_to_draw(frame, kept, view_faces, knobs, !used.filled);
  auto work = std::make_shared<ViewMapWork>();
  work->backgrounds = plan_faces(std::move(drawn.backgrounds));
  work->faces = plan_faces(std::move(drawn.faces));
  work->held = std::move(drawn.held);
  work->background_image = used.backgrounds;
  if (!work->backgrounds.faces.empty() && !used.backgrounds)
    work->background_image = use_map_image(frame, view_faces, knobs, kept.takes_turns, MapImage::backgrounds).image;
  frame.on_commit([work, &kept] {
    commit_maps(work->faces.faces, work->held, kept);
    if (work->background_image) kept.has_backgrounds = true;
  });
  ShadowMaps& maps = used.maps;
  frame.expose(maps.pyramid);
  if (work->faces.faces.empty() || !frame.status().ok()) return maps;
  for (const DrawnFace& face : work->faces.faces)
    for (const DrawnRegion& region : face.regions) maps.drawn.push_back({face.face.square, region.texels});
  prepare_maps(frame, states, knobs, kSteepestSurface, *work);
  prepare_sources(frame, {&work->backgrounds, &work->faces});
  // Rounded up, so that few different numbers of passes occur and cached frame-graph plans can be reused.
  const std::size_t batches = std::bit_ceil(work->faces.plan.batches.size());
  for (std::size_t batch = 0; batch < batches; ++batch) add_batch(frame, work, batch, maps);
  add_coarse_mips(frame, work, maps);
  frame.expose(maps.pyramid);
  return maps;
}

}  // namespace gloam
