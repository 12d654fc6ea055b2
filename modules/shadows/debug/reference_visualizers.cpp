// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/reference_visualizers.h"

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/filter/uploads.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/reference/adapter.h"
#include "shaders/shadows/maps/map_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kComparedShadowBinding = 6;

/// The inputs of a visualizer's pass.
struct ReferenceView {
  std::string name;  ///< name of the pass, and begin of the pipeline's name
  std::string image;
  gpu::ShaderCode fragment;
  ShadowsOutputs shadows;
  std::optional<shaders::ShownLightConstants> light;  ///< push constants, if any
  GeometryOutputs geometry;
  LightsOutputs lights;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
  VisualizerTargets targets;
};

gpu::GraphicsPipelineDesc view_pipeline(const ReferenceView& view, gpu::Format format) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline(view.name + "/" + std::string(gpu::name_of(format)) + "/" + view.shadows.variant, "shadows",
                          view.fragment, format);
  desc.color_formats.push_back(gpu::Format::r32_float);
  desc.constants = view.shadows.constants;
  desc.constants.push_back({0, gpu::encodes_srgb(format) ? 0u : 1u});
  return desc;
}

void record(const FrameBuilder& frame, PassContext& context, const ReferenceView& view) {
  const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, view.sampler}; };
  std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                        {1, view.lights.lights},
                                        {2, sampled(view.geometry.depth)},
                                        {3, sampled(view.geometry.normals)},
                                        {4, sampled(view.geometry.base_color)},
                                        {5, sampled(view.lights.texels)}};
  append_shadow_bindings(bindings, kComparedShadowBinding, context, view.shadows);
  std::span<const std::byte> constants;
  if (view.light) constants = std::as_bytes(std::span(&*view.light, 1));
  record_visualizer(context, frame.view(), view.targets, view.pipeline, bindings, constants);
}

Status add_pass(FrameBuilder& frame, ReferenceView view) {
  TargetOutput& target = frame.get<TargetOutput>();
  auto pipeline = frame.services().pipelines.get(view_pipeline(view, target.format));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  view.pipeline = *pipeline;
  view.sampler = *sampler;
  view.geometry = frame.get<GeometryOutputs>();
  view.lights = frame.get<LightsOutputs>();
  if (!view.lights.texels) view.lights.texels = view.geometry.base_color;  // not read without local lights
  PassBuilder pass = frame.graph().add_pass(view.name, "shadows");
  for (const ImageRef read : {view.geometry.depth, view.geometry.normals, view.geometry.base_color})
    pass.read(read, gpu::Access::fragment_read);
  if (view.lights.local_count > 0) pass.read(view.lights.texels, gpu::Access::fragment_read);
  declare_shadow_reads(pass, view.shadows, gpu::Access::fragment_read);
  view.targets = write_visualizer_targets(frame, pass, view.image, "shadows", gpu::Format::r32_float);
  view.targets.load_picture = gpu::LoadOp::clear;
  pass.execute([&frame, view](PassContext& context) { record(frame, context, view); });
  frame.expose(view.targets.values);
  return {};
}

}  // namespace

std::vector<VisualizerInfo> shadow_reference_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"shadow_reference", "shadows", "LIGHT",
       "traced visibility of the light at each pixel: black unlit, white fully lit, blue out of the light's reach"},
      {"error", "shadows", "",
       "difference between drawn and traced visibility, mean over the lights that reach the pixel: black 0, blue 0.1, "
       "cyan 0.2, green 0.3, yellow 0.4, red 0.5, white more"}};
  for (VisualizerInfo& view : views) {
    view.knob = "shadows.mode";
    view.value = "monolithic|deferred";
    view.trace = put_traced_visibility;
  }
  return views;
}

Status add_shadow_reference_view_pass(FrameBuilder& frame) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = shown.substr(0, shown.find(':'));
  if (stem != "shadow_reference" && stem != "error") return {};
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  if (shadows == nullptr) return {};
  if (traced_visibility_of(frame.world(), frame.view()) == nullptr)
    return Error{ErrorKind::usage,
                 "view " + std::string(stem) + " needs traced visibility, which only `gloam render` computes"};
  ReferenceView view;
  view.shadows = *shadows;
  if (stem == "error") {
    view.name = "shadow_error_view";
    view.image = "shadow_error";
    view.fragment = shaders::shadows::error_view_frag;
    return add_pass(frame, std::move(view));
  }
  const auto light = shown_light(frame, shown.substr(stem.size() + 1));
  if (!light) {
    frame.services().log.warning("view " + std::string(shown) +
                                 " shows the picture as it is: the light reaches nothing in view");
    return {};
  }
  // The shader of visualizer "shadow", with the constants for traced visibility.
  view.name = "shadow_reference_view";
  view.image = "shadow_reference";
  view.fragment = shaders::shadows::visibility_view_frag;
  view.light = light;
  view.shadows.constants = shadow_constants(shadow_knobs(frame.knobs()), kTracedShadows);
  view.shadows.variant = shadow_variant(view.shadows.constants);
  return add_pass(frame, std::move(view));
}

}  // namespace gloam
