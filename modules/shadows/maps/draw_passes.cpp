// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/draw_passes.h"

#include <bit>
#include <memory>
#include <utility>

#include "modules/shadows/atlas/drawn_faces.h"
#include "modules/shadows/maps/mips.h"
#include "modules/shadows/maps/recording.h"

namespace gloam {
namespace {

/// Draws resting casters into the image of backgrounds, batch by batch. The frame graph does not track this image, nor
/// the scratch image; between frames it is in state compute_read.
void record_backgrounds(FrameBuilder& frame, PassContext& context, const MapWork& work, ViewShadows& kept) {
  if (work.backgrounds.faces.empty()) return;
  gpu::CommandList& commands = context.commands();
  const gpu::ImageHandle image = kept.backgrounds.image;
  gpu::Access before = kept.backgrounds.filled ? gpu::Access::compute_read : gpu::Access::none;
  for (std::size_t batch = 0; batch < work.backgrounds.plan.batches.size(); ++batch) {
    record_draws(frame, context, work, work.backgrounds, batch);
    const std::uint32_t size = work.backgrounds.plan.batches[batch].size;
    work.scratch->begin_reading(commands, size);
    const gpu::ImageBarrier write{image, before, gpu::Access::compute_write};
    commands.barrier({}, {&write, 1});
    before = gpu::Access::compute_write;
    record_backgrounds(commands, work.mips, batch, {work.scratch->image(size), {}, {}, image});
  }
  const gpu::ImageBarrier read{image, gpu::Access::compute_write, gpu::Access::compute_read};
  commands.barrier({}, {&read, 1});
  kept.backgrounds.filled = true;
}

ShadowMipImages mip_images(PassContext& context, const MapWork& work, std::size_t batch, const ViewShadows& kept,
                           const ShadowMaps& maps) {
  return {work.scratch->image(work.faces.plan.batches[batch].size), context.image(maps.atlas),
          context.image(maps.pyramid), kept.backgrounds.filled ? kept.backgrounds.image : gpu::ImageHandle{}};
}

/// Adds the passes that draw a batch and move it into the atlas; both are empty when `index` is beyond the plan's
/// batches. The first batch also draws the frame's backgrounds.
void add_batch(FrameBuilder& frame, const std::shared_ptr<const MapWork>& work, std::size_t index, ViewShadows& kept,
               ShadowMaps& maps) {
  const bool there = index < work->faces.plan.batches.size();
  PassBuilder draw = frame.graph().add_pass("shadow_map_draw", frame.module());
  frame.read_vertices(draw);
  // The same in all batches, so that few different plans of the frame graph occur.
  declare_source_reads(draw, {&work->backgrounds, &work->faces});
  draw.keep();  // writes images the graph does not track: never cull
  if (there)
    draw.execute([&frame, work, index, &kept](PassContext& context) {
      if (index == 0) record_backgrounds(frame, context, *work, kept);
      record_draws(frame, context, *work, work->faces, index);
    });
  PassBuilder mips = frame.graph().add_pass("shadow_map_mips", frame.module());
  maps.atlas = mips.write(maps.atlas, gpu::Access::compute_write);
  maps.pyramid = mips.write(maps.pyramid, gpu::Access::compute_write);
  if (!there) return;
  mips.execute([work, index, &kept, maps](PassContext& context) {
    work->scratch->begin_reading(context.commands(), work->faces.plan.batches[index].size);
    record_batch_mips(context.commands(), work->mips, index, mip_images(context, *work, index, kept, maps));
  });
}

/// Adds the last pass; after it the atlas holds all that was drawn.
void add_coarse_mips(FrameBuilder& frame, const std::shared_ptr<const MapWork>& work, ViewShadows& kept,
                     ShadowMaps& maps) {
  PassBuilder mips = frame.graph().add_pass("shadow_map_mips", frame.module());
  maps.atlas = mips.write(maps.atlas, gpu::Access::compute_write);
  maps.pyramid = mips.write(maps.pyramid, gpu::Access::compute_write);
  mips.execute([work, maps, &kept, drawn_in = kept.history.frame()](PassContext& context) {
    const std::size_t last_batch = work->faces.plan.batches.size() - 1;
    record_coarse_mips(context.commands(), work->mips, mip_images(context, *work, last_batch, kept, maps));
    // Set here, because a frame that ends before this pass has drawn nothing.
    kept.atlas.filled = kept.pyramid.filled = true;
    for (const DrawnFace& face : work->faces.faces) {
      kept.cache.set_drawn(face.face, face.content, drawn_in);
      kept.cache.set_backgrounds(face.face, face.backgrounds);
    }
  });
}

}  // namespace

void list_shadow_map_pipelines(const ShadowKnobs& knobs, PipelineList& list) {
  list.push_back(map_pipeline(false));
  list.push_back(map_pipeline(true));
  list.push_back(pipeline_desc(shadow_mips_program(knobs.d16), "shadows"));
  list.push_back(pipeline_desc(shadow_backgrounds_program(), "shadows"));
}

ShadowMaps add_shadow_map_passes(FrameBuilder& frame, ShadowStates& states, ViewShadows& kept, const ShadowViews& views,
                                 const ShadowKnobs& knobs) {
  auto work = std::make_shared<MapWork>();
  DrawnMaps drawn = faces_to_draw(frame, kept, views, knobs);
  if (kept.counts.cached == 0 && drawn.faces.empty()) return {};
  work->backgrounds = plan_faces(std::move(drawn.backgrounds));
  work->faces = plan_faces(std::move(drawn.faces));
  FrameGraph& graph = frame.graph();
  ShadowMaps maps{
      import_kept(graph, "shadow_atlas", kept.atlas), import_kept(graph, "shadow_pyramid", kept.pyramid), {}};
  frame.expose(maps.pyramid);
  if (work->faces.faces.empty()) return maps;
  for (const DrawnFace& face : work->faces.faces)
    for (const DrawnRegion& region : face.regions) maps.drawn.push_back({face.face.square, region.texels});
  if (!work->backgrounds.faces.empty() && !frame.check(states.reserve_backgrounds(kept))) return maps;
  prepare_maps(frame, states, knobs, kSteepestSurface, *work);
  // Rounded up, so that few different numbers of passes occur and cached frame-graph plans can be reused.
  const std::size_t batches = std::bit_ceil(work->faces.plan.batches.size());
  for (std::size_t batch = 0; batch < batches; ++batch) add_batch(frame, work, batch, kept, maps);
  add_coarse_mips(frame, work, kept, maps);
  frame.expose(maps.pyramid);
  return maps;
}

}  // namespace gloam
