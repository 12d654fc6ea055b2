// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/final_list_views.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "modules/lights/outputs.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/debug/visualizers.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

void draw(FrameBuilder& frame, const std::string& name, gpu::ShaderCode fragment, std::span<const std::byte> push) {
  DrawProgram program{.fragment = fragment,
                      .constants = frame.get<ShadowsOutputs>().final_lists->constants,
                      .blend = gpu::BlendMode::alpha};
  program.constants.set("kEarlyLists", frame.get<LightsOutputs>().has_lists() ? 1u : 0u);
  if (name != "light_list") program.constants.set("kSlots", name == "visibility_slots" ? 1u : 0u);
  draw_shadow_picture(frame, {.pass = name + "_view",
                              .values = name,
                              .format = name == "light_list" ? gpu::Format::rgba8_unorm : gpu::Format::rgba16_float,
                              .program = std::move(program),
                              .push = push});
}

}  // namespace

std::string reason_without_lists(const FrameBuilder& frame) {
  const KnobRegistry& knobs = frame.knobs();
  const ShadowMode mode = knobs.value(kShadowMode);
  if (mode != ShadowMode::deferred) return "there are no final lists with " + assignment_of(kShadowMode, mode);
  if (knobs.value(kVisibilityLevels) == 0)
    return "there are no final lists with " + assignment_of(kVisibilityLevels, 0);
  if (knobs.value(kLightCulling) == LightCulling::brute)
    return "there are no final lists with " + assignment_of(kLightCulling, LightCulling::brute);
  return "no light in view has a shadow map";
}

std::vector<VisualizerInfo> final_list_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"visibility_slots", "shadows", "",
       "number of visibility slots of each 8x8 tile; no slots: "
       "darkened if lights are fully visible in the whole tile, dark blue if all lights are unlit in it, black if no "
       "light reaches it; magenta: a buffer was full, the tile is shaded from shadow maps"},
      {"lights_final", "shadows", "",
       "number of lights in the final list of each 8x8 tile; magenta: a buffer was full, the tile has no final list"}};
  for (VisualizerInfo& view : views) {
    view.knob = kShadowMode.name;
    view.value = text_of(kShadowMode, ShadowMode::deferred);
    view.shows_lists = true;
    view.heat = {.most = view.name == "lights_final" ? 31.0 : 10.0, .counts = true};
  }
  return views;
}

void take_light_list_view(FrameBuilder& frame) {
  if (find_final_lists(frame) != nullptr) frame.put(LightListViewTaken{});
}

void add_final_list_view_pass(FrameBuilder& frame, OnceLog& once_log) {
  const std::string_view shown = frame.visualizer();
  const std::string stem(shown.substr(0, shown.find(':')));
  if (stem == "light_list") {
    if (frame.find<LightListViewTaken>() == nullptr) return;
    if (const auto light = shown_light(frame, shown.substr(stem.size() + 1)))
      draw(frame, stem, shaders::shadows::final_light_view_frag, std::as_bytes(std::span(&*light, 1)));
  } else if (stem == "lights_final" || stem == "visibility_slots") {
    const std::uint32_t directional_count = frame.get<LightsOutputs>().directional_count;
    if (find_final_lists(frame) != nullptr)
      draw(frame, stem, shaders::shadows::final_count_view_frag, std::as_bytes(std::span(&directional_count, 1)));
    else
      once_log.warning(frame.log(), "view " + stem + " shows the picture as it is: " + reason_without_lists(frame));
  }
}

}  // namespace gloam
