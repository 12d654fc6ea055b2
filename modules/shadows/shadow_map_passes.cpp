// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/shadow_map_passes.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "engine/render/mesh_packing.h"
#include "modules/shadows/drawn_faces.h"
#include "modules/shadows/scratch_plan.h"
#include "modules/shadows/shadow_mips.h"
#include "shaders/shadows/shaders.h"
#include "shaders/shadows/shadow_map_shared.h"

namespace gloam {
namespace {

constexpr float kSlopeBias = 1.0f;

gpu::GraphicsPipelineDesc map_pipeline(bool cut_out) {
  gpu::GraphicsPipelineDesc desc;
  desc.name = cut_out ? "shadow_map/cut_out" : "shadow_map/opaque";
  desc.module = "shadows";
  desc.vertex = cut_out ? shaders::shadows::shadow_map_mask_vert : shaders::shadows::shadow_map_vert;
  desc.attributes = {{0, 0, gpu::Format::rgb32_float, 0}};
  desc.stream_strides = {sizeof(vec3)};
  if (cut_out) {
    desc.fragment = shaders::shadows::shadow_map_mask_frag;
    desc.attributes.push_back({1, 1, gpu::Format::rgba32_float, offsetof(PackedSurface, uv0)});
    desc.attributes.push_back({2, 1, gpu::Format::rgba8_unorm, offsetof(PackedSurface, color)});
    desc.stream_strides.push_back(sizeof(PackedSurface));
  }
  desc.depth_format = gpu::Format::d32_float;
  desc.cull = gpu::CullMode::none;  // sheets without thickness cast shadows from either side
  desc.depth_compare = gpu::CompareOp::greater_equal;
  desc.depth_bias = true;
  return desc;
}

/// All that is drawn in this frame; outlives the declaration, as pass functions run later.
struct MapWork {
  FacePlan backgrounds;
  FacePlan faces;
  const ShadowScratch* scratch = nullptr;
  ShadowKnobs knobs;
  gpu::PipelineHandle opaque;
  gpu::PipelineHandle cut_out;
  ShadowMipWork mips;
};

/// Records the draws of regions; the viewport is set.
class FaceRecorder {
 public:
  FaceRecorder(FrameBuilder& frame, PassContext& context, const MapWork& work)
      : frame_(frame), context_(context), commands_(context.commands()), work_(work) {}

  void record(const DrawnFace& face, const DrawnRegion& region) {
    for (std::size_t i = 0; i < region.draws.size(); ++i) {
      const FaceDraw& draw = region.draws[i];
      const Caster& caster = *draw.caster;
      const bool cut_out = is_cut_out(caster);
      bind(cut_out ? work_.cut_out : work_.opaque);
      frame_.bind_caster_vertices(context_, caster, cut_out);
      if (cut_out) commands_.bind_set(1, frame_.scene().materials()[caster.primitive->material].set);
      commands_.push(shaders::ShadowDrawConstants{region.matrices[i], face.face.tan_half > 0.0f ? 0u : 1u});
      commands_.draw_indexed(draw.index_count, 1, draw.first_index, 0, 0);
    }
  }

 private:
  void bind(gpu::PipelineHandle pipeline) {
    if (bound_ == pipeline) return;
    commands_.bind_pipeline(pipeline);
    commands_.set_depth_bias(-work_.knobs.bias_units, -kSlopeBias);  // depth is reversed: less is farther
    bound_ = pipeline;
  }

  FrameBuilder& frame_;
  PassContext& context_;
  gpu::CommandList& commands_;
  const MapWork& work_;
  gpu::PipelineHandle bound_;
};

/// Begins drawing into a part of a layer; what lies there is cleared. Viewport: the whole face, so that depths do not depend on the part.
void begin_region(gpu::CommandList& commands, const gpu::ImageView& layer, std::uint32_t size,
                  const TexelRect& texels) {
  gpu::RenderingDesc rendering;
  rendering.depth.view = layer;
  const uvec2 extent = texels.end - texels.begin;
  rendering.x = texels.begin.x;
  rendering.y = texels.begin.y;
  rendering.width = extent.x;
  rendering.height = extent.y;
  commands.begin_rendering(rendering);
  const auto side = static_cast<float>(size);
  commands.set_viewport(0.0f, 0.0f, side, side);
  commands.set_scissor(static_cast<std::int32_t>(texels.begin.x), static_cast<std::int32_t>(texels.begin.y), extent.x,
                       extent.y);
}

void record_draws(FrameBuilder& frame, PassContext& context, const MapWork& work, const FacePlan& plan,
                  std::size_t index) {
  const ScratchPlan::Batch& batch = plan.plan.batches[index];
  gpu::CommandList& commands = context.commands();
  FaceRecorder recorder(frame, context, work);
  work.scratch->begin_drawing(commands, batch.size);
  commands.bind_indices(frame.scene().indices(), 0);
  for (std::uint32_t layer = 0; layer < batch.items.size(); ++layer) {
    const DrawnFace& face = plan.faces[batch.items[layer]];
    const gpu::ImageView view{.image = work.scratch->image(batch.size), .first_layer = layer, .layer_count = 1};
    for (const DrawnRegion& region : face.regions) {
      begin_region(commands, view, batch.size, region.texels);
      recorder.record(face, region);
      commands.end_rendering();
    }
  }
}

Status make_pipelines(FrameBuilder& frame, MapWork& work) {
  Pipelines& pipelines = frame.services().pipelines;
  bool any_cut_out = false;
  for (const FacePlan* plan : {&work.backgrounds, &work.faces})
    for (const DrawnFace& face : plan->faces)
      for (const DrawnRegion& region : face.regions)  // cut-out casters come last
        any_cut_out = any_cut_out || (!region.draws.empty() && is_cut_out(*region.draws.back().caster));
  auto opaque = pipelines.get(map_pipeline(false));
  if (!opaque.ok()) return opaque.error();
  work.opaque = *opaque;
  if (any_cut_out) {
    auto cut_out = pipelines.get(map_pipeline(true));
    if (!cut_out.ok()) return cut_out.error();
    work.cut_out = *cut_out;
  }
  return {};
}

/// Draws what casters that rest make of parts of faces, batch by batch, into the image of backgrounds. The graph does not know it, as it
/// does not know the scratch map; between frames it is ready to be read.
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

/// Draws a batch and moves it into the atlas; nothing where the plan has no such batch. Before the first: the frame's backgrounds.
void add_batch(FrameBuilder& frame, const std::shared_ptr<const MapWork>& work, std::size_t index, ViewShadows& kept,
               ShadowMaps& maps) {
  const bool there = index < work->faces.plan.batches.size();
  PassBuilder draw = frame.graph().add_pass("shadow_map_draw", "shadows");
  frame.read_vertices(draw);
  draw.keep();  // what it writes, the graph does not know
  if (there)
    draw.execute([&frame, work, index, &kept](PassContext& context) {
      if (index == 0) record_backgrounds(frame, context, *work, kept);
      record_draws(frame, context, *work, work->faces, index);
    });
  PassBuilder mips = frame.graph().add_pass("shadow_map_mips", "shadows");
  maps.atlas = mips.write(maps.atlas, gpu::Access::compute_write);
  maps.pyramid = mips.write(maps.pyramid, gpu::Access::compute_write);
  if (!there) return;
  mips.execute([work, index, &kept, maps](PassContext& context) {
    work->scratch->begin_reading(context.commands(), work->faces.plan.batches[index].size);
    record_batch_mips(context.commands(), work->mips, index, mip_images(context, *work, index, kept, maps));
  });
}

/// The last of the passes: then the atlas holds what was drawn.
void add_coarse_mips(FrameBuilder& frame, const std::shared_ptr<const MapWork>& work, ViewShadows& kept,
                     ShadowMaps& maps) {
  PassBuilder mips = frame.graph().add_pass("shadow_map_mips", "shadows");
  maps.atlas = mips.write(maps.atlas, gpu::Access::compute_write);
  maps.pyramid = mips.write(maps.pyramid, gpu::Access::compute_write);
  mips.execute([work, maps, &kept, drawn_in = kept.history.frame()](PassContext& context) {
    const std::size_t last_batch = work->faces.plan.batches.size() - 1;
    record_coarse_mips(context.commands(), work->mips, mip_images(context, *work, last_batch, kept, maps));
    // Only now: a frame that ended before has drawn nothing.
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
  list.push_back(shadow_mips_pipeline(knobs.d16));
  list.push_back(shadow_backgrounds_pipeline());
}

Result<ShadowMaps> add_shadow_map_passes(FrameBuilder& frame, ShadowStates& states, ViewShadows& kept,
                                         const ShadowViews& views, const ShadowKnobs& knobs) {
  auto work = std::make_shared<MapWork>();
  work->knobs = knobs;
  DrawnMaps drawn = faces_to_draw(frame, kept, views, knobs);
  if (kept.counts.cached == 0 && drawn.faces.empty()) return ShadowMaps{};
  work->backgrounds = plan_faces(std::move(drawn.backgrounds));
  work->faces = plan_faces(std::move(drawn.faces));
  FrameGraph& graph = frame.graph();
  const auto import = [&](const char* name, const KeptImage& image) {
    return graph.import_image(name, image.image, image.filled ? gpu::Access::fragment_read : gpu::Access::none,
                              gpu::Access::fragment_read);
  };
  ShadowMaps maps{import("shadow_atlas", kept.atlas), import("shadow_pyramid", kept.pyramid), {}};
  frame.expose(maps.pyramid);
  if (work->faces.faces.empty()) return maps;
  GLOAM_TRY(make_pipelines(frame, *work));
  for (const DrawnFace& face : work->faces.faces)
    for (const DrawnRegion& region : face.regions) maps.drawn.push_back({face.face.square, region.texels});
  if (!work->backgrounds.faces.empty()) GLOAM_TRY(states.reserve_backgrounds(kept));
  auto mips = plan_shadow_mips(frame, work->backgrounds, work->faces, knobs);
  if (!mips.ok()) return mips.error();
  work->mips = *mips;
  auto scratch = states.scratch(std::max(work->backgrounds.plan.texels(), work->faces.plan.texels()));
  if (!scratch.ok()) return scratch.error();
  work->scratch = *scratch;
  // Few different numbers of passes, so that the frame's plans are met again.
  const std::size_t batches = std::bit_ceil(work->faces.plan.batches.size());
  for (std::size_t batch = 0; batch < batches; ++batch) add_batch(frame, work, batch, kept, maps);
  add_coarse_mips(frame, work, kept, maps);
  frame.expose(maps.pyramid);
  return maps;
}

}  // namespace gloam
