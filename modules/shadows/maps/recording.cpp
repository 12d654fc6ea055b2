// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/recording.h"

#include <algorithm>

#include "engine/render/packing/mesh_packing.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr float kSlopeBias = 1.0f;

}  // namespace

gpu::GraphicsPipelineDesc map_pipeline(MapDraw draw) {
  const bool cut_out = draw == MapDraw::cut_out;
  CasterProgram program;
  if (draw == MapDraw::fronts) program.cull = gpu::CullMode::back;
  if (draw == MapDraw::backs) program.cull = gpu::CullMode::front;
  program.vertex = cut_out ? shaders::shadows::map_mask_vert : shaders::shadows::map_vert;
  program.attributes = {{0, 0, gpu::Format::rgb32_float, 0}};
  program.stream_strides = {sizeof(vec3)};
  if (cut_out) {
    program.fragment = shaders::shadows::map_mask_frag;
    program.attributes.push_back({1, 1, gpu::Format::rgba32_float, offsetof(PackedSurface, uv0)});
    program.attributes.push_back({2, 1, gpu::Format::rgba16_float, offsetof(PackedSurface, color)});
    program.stream_strides.push_back(sizeof(PackedSurface));
  }
  return caster_pipeline_desc(program, "shadows");
}

namespace {

/// Records the draws of regions. The viewport must be set.
class FaceRecorder {
 public:
  FaceRecorder(FrameBuilder& frame, PassContext& context, const MapWork& map)
      : frame_(frame), context_(context), commands_(context.commands()), map_(map) {}

  void record(const DrawnFace& face, const DrawnRegion& region) {
    record_casters(face, region);
    record_sources(face, region);
  }

 private:
  void record_casters(const DrawnFace& face, const DrawnRegion& region) {
    for (std::size_t i = 0; i < region.draws.size(); ++i) {
      const FaceDraw& draw = region.draws[i];
      const Caster& caster = *draw.caster;
      const bool cut_out = is_cut_out(caster);
      bind(cut_out ? map_.cut_out : draw.fronts_only ? map_.fronts : draw.backs_only ? map_.backs : map_.whole);
      frame_.bind_caster_vertices(context_, caster, cut_out);
      if (cut_out) commands_.bind_set(1, frame_.scene().material(caster.primitive->material).set);
      commands_.push(shaders::CasterConstants{region.matrices[i], face.face.tan_half > 0.0f ? 0u : 1u});
      commands_.draw_indexed(draw.index_count, 1, draw.first_index, 0, 0);
    }
  }
  void record_sources(const DrawnFace& face, const DrawnRegion& region) {
    if (region.sources.empty()) return;
    const CasterProjection projection = projection_of(face.face);
    for (std::size_t i = 0; i < region.sources.size(); ++i) {
      const std::uint32_t part = region.parts.empty() ? CasterSourceDraw::kNoPart : region.parts[i];
      region.sources[i]->record(
          CasterSourceDraw(context_, projection, face.face.square.size, -map_.bias_units, -kSlopeBias, part));
    }
    bound_ = {};  // sources bind pipelines and indices
  }
  void bind(gpu::PipelineHandle pipeline) {
    if (bound_ == pipeline) return;
    if (!bound_) commands_.bind_indices(frame_.scene().indices(), 0);
    commands_.bind_pipeline(pipeline);
    commands_.set_depth_bias(-map_.bias_units, -kSlopeBias);  // negative: depth is reversed
    bound_ = pipeline;
  }

  FrameBuilder& frame_;
  PassContext& context_;
  gpu::CommandList& commands_;
  const MapWork& map_;
  gpu::PipelineHandle bound_;
};

/// Begins drawing into a part of a layer, and clears it. The viewport is the whole face, so that depths do not depend
/// on the part.
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

/// The part of clip space that a rectangle of the face's texels shows.
CasterSourcePart source_part(const ShadowFace& face, const TexelRect& texels) {
  const vec2 begin = 2.0f * vec2(texels.begin) / static_cast<float>(face.square.size) - 1.0f;
  const vec2 end = 2.0f * vec2(texels.end) / static_cast<float>(face.square.size) - 1.0f;
  CasterSourcePart part{.projection = projection_of(face)};
  part.clip = vec4(begin.x, -end.y, end.x, -begin.y);
  if (face.tan_half > 0.0f) part.reach_m = face.far_m;
  return part;
}

/// Whether this flag of FaceDraw is set in any draw of the plan.
bool draws(const FacePlan& plan, bool FaceDraw::*flag) {
  for (const DrawnFace& face : plan.faces)
    for (const DrawnRegion& region : face.regions)
      if (std::ranges::any_of(region.draws, flag)) return true;
  return false;
}

bool draws_cut_outs(const FacePlan& plan) {
  for (const DrawnFace& face : plan.faces)
    for (const DrawnRegion& region : face.regions)  // cut-out casters come last
      if (!region.draws.empty() && is_cut_out(*region.draws.back().caster)) return true;
  return false;
}

}  // namespace

void prepare_sources(FrameBuilder& frame, std::initializer_list<FacePlan*> plans) {
  struct Prepared {
    const CasterSource* source;
    std::vector<CasterSourcePart> parts;
    std::vector<std::uint32_t*> indices;
  };
  std::vector<Prepared> prepared;
  for (FacePlan* plan : plans)
    for (DrawnFace& face : plan->faces)
      for (DrawnRegion& region : face.regions) {
        region.parts.assign(region.sources.size(), CasterSourceDraw::kNoPart);
        for (std::size_t i = 0; i < region.sources.size(); ++i) {
          const CasterSource* source = region.sources[i];
          if (source->prepare == nullptr) continue;
          auto found = std::ranges::find(prepared, source, &Prepared::source);
          if (found == prepared.end()) found = prepared.insert(found, {source, {}, {}});
          found->parts.push_back(source_part(face.face, region.texels));
          found->indices.push_back(&region.parts[i]);
        }
      }
  for (const Prepared& one : prepared) {
    const std::uint32_t first = one.source->prepare(frame, one.parts);
    for (std::size_t i = 0; i < one.indices.size(); ++i)
      *one.indices[i] = first == CasterSourceDraw::kNoPart ? first : first + static_cast<std::uint32_t>(i);
  }
}

void declare_source_reads(PassBuilder& pass, std::initializer_list<const FacePlan*> plans) {
  std::vector<const CasterSource*> declared;
  for (const FacePlan* plan : plans)
    for (const DrawnFace& face : plan->faces)
      for (const DrawnRegion& region : face.regions)
        for (const CasterSource* source : region.sources) {
          if (source->declare_reads == nullptr || std::ranges::find(declared, source) != declared.end()) continue;
          declared.push_back(source);
        }
  for (const CasterSource* source : declared) source->declare_reads(pass);
}

void record_draws(FrameBuilder& frame, PassContext& context, const MapWork& map, const FacePlan& plan,
                  std::size_t index) {
  const ScratchPlan::Batch& batch = plan.plan.batches[index];
  gpu::CommandList& commands = context.commands();
  FaceRecorder recorder(frame, context, map);
  map.scratch->begin_drawing(commands, batch.size);
  for (std::uint32_t layer = 0; layer < batch.items.size(); ++layer) {
    const DrawnFace& face = plan.faces[batch.items[layer]];
    const gpu::ImageView view{.image = map.scratch->image(batch.size), .first_layer = layer, .layer_count = 1};
    for (const DrawnRegion& region : face.regions) {
      begin_region(commands, view, batch.size, region.texels);
      recorder.record(face, region);
      commands.end_rendering();
    }
  }
}

void prepare_maps(FrameBuilder& frame, ShadowStates& states, const ShadowKnobs& knobs, float steepest, MapWork& work,
                  MapMips mips) {
  for (const FacePlan* plan : {&work.backgrounds, &work.faces})
    for (const DrawnFace& face : plan->faces)
      for (const DrawnRegion& region : face.regions)
        for (const FaceDraw& draw : region.draws) frame.use_caster_vertices(*draw.caster);
  work.bias_units = knobs.bias_units;
  work.whole = pipeline_of(frame, map_pipeline(MapDraw::whole));
  const auto any_draws = [&](bool FaceDraw::*flag) { return draws(work.faces, flag) || draws(work.backgrounds, flag); };
  if (any_draws(&FaceDraw::fronts_only)) work.fronts = pipeline_of(frame, map_pipeline(MapDraw::fronts));
  if (any_draws(&FaceDraw::backs_only)) work.backs = pipeline_of(frame, map_pipeline(MapDraw::backs));
  if (draws_cut_outs(work.backgrounds) || draws_cut_outs(work.faces))
    work.cut_out = pipeline_of(frame, map_pipeline(MapDraw::cut_out));
  work.mips = plan_shadow_mips(frame, work.backgrounds, work.faces, knobs, steepest, mips);
  auto scratch = states.scratch(std::max(work.backgrounds.plan.texels(), work.faces.plan.texels()));
  if (frame.check(scratch)) work.scratch = *scratch;
}

}  // namespace gloam
