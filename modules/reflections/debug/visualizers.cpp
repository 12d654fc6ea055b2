// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/visualizers.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/culling/tiles.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

constexpr const char* kReflectionViews[] = {"reflection_tier", "reflection_confidence", "ibr_tiles", "ibr_layers",
                                            "probes"};

}  // namespace

std::vector<VisualizerInfo> reflection_visualizers(const ExtrasOf& extras) {
  std::vector<VisualizerInfo> views = {
      {"reflection_tier", "reflections", "",
       "the tier that each reflection comes from: green screen space, orange proxies, blue probes with a box, violet "
       "the global probe and the sky; dark: no reflection",
       true, "reflections.mode", "tiers"},
      {"reflection_confidence", "reflections", "", "confidence of screen space at each pixel", true, "reflections.mode",
       "tiers"},
      {"ibr_tiles", "reflections", "", "number of proxies in the list of each vertical screen tile"},
      {"ibr_layers", "reflections", "", "layers along each mirrored ray, proxies and the hit of screen space"},
      {"probes", "reflections", "", "radiance of the probes in the mirror direction of each pixel, as x / (1 + x)"},
      {"reflection_reference", "reflections", "", "the picture with traced reflections in place of all tiers"}};
  for (VisualizerInfo& view : views) {
    if (view.name == "reflection_confidence") view.heat = {1.0};
    if (view.name == "ibr_tiles") view.heat = {31.0};
    if (view.name == "ibr_layers") view.heat = {5.0};
  }
  views.back().trace = [extras](World& world, const ReferenceInput& input) {
    return put_traced_reflections(world, input, extras);
  };
  return views;
}

void add_reflection_view_pass(FrameBuilder& frame) {
  const auto* shown = std::ranges::find(kReflectionViews, frame.visualizer());
  const ReflectionFrame* reflections = frame.find<ReflectionFrame>();
  if (shown == std::end(kReflectionViews) || reflections == nullptr) return;
  const auto code = static_cast<std::uint32_t>(shown - std::begin(kReflectionViews));
  DrawProgram program{.fragment = shaders::reflections::reflection_view_frag,
                      .constants = visualizer_constants(frame),
                      .blend = gpu::BlendMode::alpha};
  program.constants.set("kShown", code);
  DrawPass pass(frame, std::string(*shown) + "_view", program);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("reflection", reflections->block);
  pass.read("tiles", reflections->tiles);
  pass.read("ssr_color", reflections->ssr_color);
  pass.read("color_image", reflections->color);
  pass.read_if_declared("surface_image", reflections->surface);
  pass.read("probe_images", reflections->probe_images, Sampling::linear);
  bind_rows(pass, "proxy_rows", reflections->proxies);
  bind_rows(pass, "proxy_masks", frame.world().view_resource<ProxyTiles>(frame.view().id).masks);
  bind_rows(pass, "probe_rows", reflections->probes);
  const std::uint32_t tiers = (reflections->ssr_color ? 1u : 0u) |
                              (reflections->mirror && reflections->knobs.proxies ? 2u : 0u) |
                              (reflections->probes.empty() ? 0u : 4u);
  pass.push(tiers);
  add_visualizer_targets(frame, pass, *shown, gpu::Format::rgba16_float);
  pass.draw_triangle();
}

}  // namespace gloam
