// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/visualizers.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/frame.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/reference/indirect_tracing.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

constexpr const char* kReflectionViews[] = {"reflection_tier", "reflection_confidence", "ibr_tiles", "ibr_layers",
                                            "probes"};
constexpr const char* kTracedView = "reflection_reference";
constexpr const char* kIndirectView = "indirect_reference";

}  // namespace

std::vector<VisualizerInfo> reflection_visualizers(const ExtrasOf& extras) {
  const std::string mode(kReflectionMode.name), tiers = text_of(kReflectionMode, ReflectionKnobs::Mode::tiers);
  std::vector<VisualizerInfo> views = {
      {"reflection_tier", "reflections", "",
       "the tier that each reflection comes from: green screen space, orange proxies, blue probes with a box, violet "
       "the global probe and the sky; dark: no reflection",
       mode, tiers},
      {"reflection_confidence", "reflections", "", "confidence of screen space at each pixel", mode, tiers},
      {"ibr_tiles", "reflections", "", "number of proxies in the list of each vertical screen tile"},
      {"ibr_layers", "reflections", "", "layers along each mirrored ray, proxies and the hit of screen space"},
      {"probes", "reflections", "", "radiance of the probes in the mirror direction of each pixel, as x / (1 + x)"},
      {kTracedView, "reflections", "", "the picture with traced reflections in place of all tiers"}};
  for (VisualizerInfo& view : views) {
    if (view.name == "reflection_confidence") view.heat = {1.0};
    if (view.name == "ibr_tiles") view.heat = {.most = 31.0, .counts = true};
    if (view.name == "ibr_layers") view.heat = {.most = 5.0, .counts = true};
  }
  views.push_back({kIndirectView, "reflections", "",
                   "the picture with light that one diffuse bounce brings, traced, in place of lighting.indirect"});
  views.back().trace = &put_traced_indirect;
  views[views.size() - 2].trace = [extras](World& world, const ReferenceInput& input) {
    return put_traced_reflections(world, input, extras);
  };
  return views;
}

void announce_reflection_view(FrameBuilder& frame) {
  if (frame.visualizer() == kTracedView || frame.visualizer() == kIndirectView) frame.put(VisualizerIsPicture{});
}

void add_reflection_view_pass(FrameBuilder& frame) {
  const auto* shown = std::ranges::find(kReflectionViews, frame.visualizer());
  const ReflectionPlan* plan = frame.find<ReflectionPlan>();
  const ReflectionHandles* drawn = frame.find<ReflectionHandles>();
  if (shown == std::end(kReflectionViews) || plan == nullptr || drawn == nullptr) return;
  const auto code = static_cast<std::uint32_t>(shown - std::begin(kReflectionViews));
  DrawProgram program{.fragment = shaders::reflections::reflection_view_frag,
                      .constants = visualizer_constants(frame),
                      .blend = gpu::BlendMode::alpha};
  program.constants.set("kShown", code);
  DrawPass pass(frame, std::string(*shown) + "_view", program);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("reflection", drawn->uniforms.block);
  pass.read("tiles", drawn->uniforms.tiles);
  pass.read("ssr_color", drawn->hits.color);
  pass.read("color_image", drawn->light.color);
  pass.read_if_declared("surface_image", drawn->light.surface);
  const SurroundingProbes& probes = frame.get<SurroundingProbes>();
  pass.read("probe_images", probes.images, Sampling::linear);
  pass.read("mirror_image", drawn->mirrors);
  bind_rows<shaders::ProxyRow>(pass, "proxy_rows", plan->proxies);
  bind_rows<std::uint32_t>(pass, "proxy_masks", frame.world().view_resource<ProxyTiles>(frame.view().id).masks);
  bind_rows<shaders::ProbeRow>(pass, "probe_rows", probes.rows);
  const std::uint32_t tiers = (drawn->hits.color ? 1u : 0u) | (plan->mirror && plan->knobs.proxies ? 2u : 0u) |
                              (probes.rows.empty() ? 0u : 4u) | (plan->knobs.naive ? 8u : 0u) |
                              (drawn->mirrors ? 16u : 0u);
  pass.push(tiers);
  add_visualizer_targets(frame, pass, *shown, gpu::Format::rgba16_float);
  pass.draw_triangle();
}

}  // namespace gloam
