// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/final_list_views.h"

#include <optional>
#include <span>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

/// First of four bindings: GLOAM_FINAL_LISTS_BINDING of final_list_views.glsl.
constexpr std::uint32_t kViewedListBinding = 9;

enum class FinalView : std::uint8_t { counts, slots, light };

std::optional<FinalView> view_of(std::string_view stem) {
  if (stem == "lights_final") return FinalView::counts;
  if (stem == "visibility_slots") return FinalView::slots;
  if (stem == "light_list") return FinalView::light;
  return std::nullopt;
}

/// The inputs of a visualizer's pass.
struct ViewDraw {
  FinalView view = FinalView::counts;
  shaders::ShownLightConstants light{};  ///< for FinalView::light
  gpu::PipelineHandle pipeline;
  GeometryOutputs geometry;
  LightsOutputs lights;
  FinalLists lists;
  gpu::SamplerHandle sampler;
  VisualizerTargets targets;
};

gpu::GraphicsPipelineDesc view_pipeline(const ViewDraw& draw, gpu::Format format) {
  const bool one_light = draw.view == FinalView::light, slots = draw.view == FinalView::slots,
             early = draw.lights.has_lists();
  std::string name = one_light ? "final_light_view" : slots ? "visibility_slots_view" : "final_count_view";
  name += "/" + std::string(gpu::name_of(format)) + "/" + draw.lists.variant + (early ? "" : "/directional");
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline(
      std::move(name), "shadows",
      one_light ? shaders::shadows::final_light_view_frag : shaders::shadows::final_count_view_frag, format);
  desc.color_formats.push_back(gpu::Format::rgba8_unorm);
  desc.blend = gpu::BlendMode::alpha;
  desc.constants = draw.lists.constants;
  desc.constants.push_back({0, gpu::encodes_srgb(format) ? 0u : 1u});
  desc.constants.push_back({1, early ? 1u : 0u});
  if (!one_light) desc.constants.push_back({2, slots ? 1u : 0u});
  return desc;
}

void declare_reads(PassBuilder& pass, const ViewDraw& draw) {
  for (const ImageRef image : {draw.geometry.depth, draw.geometry.normals, draw.geometry.depth_bounds})
    pass.read(image, gpu::Access::fragment_read);
  declare_final_list_reads(pass, draw.lists, gpu::Access::fragment_read);
  if (!draw.lights.has_lists()) return;
  pass.read(draw.lights.texels, gpu::Access::fragment_read);
  pass.read(draw.lights.tile_lists, gpu::Access::fragment_read);
  pass.read(draw.lights.early_lists, gpu::Access::fragment_read);
  pass.read(draw.lights.group_masks, gpu::Access::fragment_read);
}

/// Without local lights shaders read no early list, but every binding must be set.
std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context, const ViewDraw& draw) {
  const auto sampled = [&](ImageRef image) {
    return gpu::Binding::Sampled{{.image = context.image(image)}, draw.sampler};
  };
  const auto whole = [&](BufferRef buffer) { return gpu::Binding::BufferRange{context.buffer(buffer)}; };
  const LightsOutputs& lights = draw.lights;
  const bool early = lights.has_lists();
  std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                        {1, early ? lights.grid : lights.lights},
                                        {2, sampled(draw.geometry.depth)},
                                        {3, sampled(early ? lights.texels : draw.geometry.depth)},
                                        {4, whole(early ? lights.group_masks : draw.lists.entries)},
                                        {5, sampled(early ? lights.tile_lists : draw.geometry.normals)},
                                        {6, whole(early ? lights.early_lists : draw.lists.entries)},
                                        {7, sampled(draw.geometry.depth_bounds)}};
  append_final_list_bindings(bindings, kViewedListBinding, context, draw.lists, draw.sampler);
  return bindings;
}

void record(const FrameBuilder& frame, PassContext& context, const ViewDraw& draw) {
  const auto constants = draw.view == FinalView::light ? std::as_bytes(std::span(&draw.light, 1))
                                                       : std::as_bytes(std::span(&draw.lights.directional_count, 1));
  record_visualizer(context, frame.view(), draw.targets, draw.pipeline, bindings_of(frame, context, draw), constants);
}

/// Why a frame with shadows has no final lists.
std::string reason_without_lists(const FrameBuilder& frame) {
  const KnobRegistry& knobs = frame.knobs();
  if (!knobs.is("shadows.mode", "deferred"))
    return "there are no final lists with shadows.mode=" + knobs.text("shadows.mode");
  if (knobs.is("shadows.visibility_bits", "exact"))
    return "there are no final lists with shadows.visibility_bits=exact";
  if (knobs.is("lights.culling", "brute")) return "there are no final lists with lights.culling=brute";
  return "no light in view has a shadow map";
}

Status add_pass(FrameBuilder& frame, ViewDraw draw, const std::string& stem) {
  TargetOutput& target = frame.get<TargetOutput>();
  const ShadowsOutputs& shadows = frame.get<ShadowsOutputs>();
  draw.geometry = frame.get<GeometryOutputs>();
  draw.lights = frame.get<LightsOutputs>();
  draw.lists = *shadows.final_lists;
  draw.sampler = shadows.nearest;
  auto pipeline = frame.services().pipelines.get(view_pipeline(draw, target.format));
  if (!pipeline.ok()) return pipeline.error();
  draw.pipeline = *pipeline;
  PassBuilder pass = frame.graph().add_pass(stem + "_view", "shadows");
  declare_reads(pass, draw);
  draw.targets = write_visualizer_targets(frame, pass, stem, "shadows", gpu::Format::rgba8_unorm);
  pass.execute([&frame, draw](PassContext& context) { record(frame, context, draw); });
  return {};
}

bool has_final_lists(const FrameBuilder& frame) {
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  return shadows != nullptr && shadows->final_lists.has_value();
}

}  // namespace

std::vector<VisualizerInfo> final_list_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"visibility_slots", "shadows", "",
       "number of visibility slots of each 8x8 tile: blue 2, cyan 4, green 6, yellow 8, red 10, white more; no slots: "
       "darkened if lights are fully visible in the whole tile, dark blue if all lights are unlit in it, black if no "
       "light reaches it; magenta: a buffer was full, the tile is shaded from shadow maps"},
      {"lights_final", "shadows", "",
       "number of lights in the final list of each 8x8 tile: black 0, blue 6, cyan 12, green 19, yellow 25, red 31, "
       "white 32 and more; magenta: a buffer was full, the tile has no final list"}};
  for (VisualizerInfo& view : views) {
    view.knob = "shadows.mode";
    view.value = "deferred";
  }
  return views;
}

void take_light_list_view(FrameBuilder& frame) {
  if (has_final_lists(frame)) frame.put(LightListViewTaken{});
}

Status add_final_list_view_pass(FrameBuilder& frame, const std::function<void(const std::string& sentence)>& warn) {
  const std::string_view shown = frame.visualizer();
  const std::string stem(shown.substr(0, shown.find(':')));
  const std::optional<FinalView> view = view_of(stem);
  if (!view) return {};
  ViewDraw draw;
  draw.view = *view;
  if (*view == FinalView::light) {
    if (frame.find<LightListViewTaken>() == nullptr) return {};
    const auto light = shown_light(frame, shown.substr(stem.size() + 1));
    if (!light) return {};
    draw.light = *light;
  } else if (!has_final_lists(frame)) {
    warn("view " + stem + " shows the picture as it is: " + reason_without_lists(frame));
    return {};
  }
  return add_pass(frame, std::move(draw), stem);
}

}  // namespace gloam
