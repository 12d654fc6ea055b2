// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/unculled_view.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/shadows/debug/final_list_views.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/debug/visualizers.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::string_view kUnculled = kUnculledVisualizers[0], kFiltered = kUnculledVisualizers[1];

/// The light's visibility in one of the visibility_view shaders.
ImageRef visibility_of(FrameBuilder& frame, const shaders::ShownLightConstants& light, const ShadowsOutputs& shadows,
                       const char* name, DrawProgram program) {
  program.constants.set("kKinds", kind_of(frame, light));
  return draw_shadow_picture(frame, {.pass = std::string(name) + "_view",
                                     .values = name,
                                     .program = std::move(program),
                                     .push = std::as_bytes(std::span(&light, 1)),
                                     .shadows = &shadows});
}

void add_comparison(FrameBuilder& frame, ImageRef unculled, ImageRef drawn) {
  const auto* closeups = frame.find<UnculledCloseups>();
  DrawProgram program{shaders::shadows::culling_view_frag, visualizer_constants(frame)};
  program.constants.set("kCloseups", closeups == nullptr ? 0u : 1u);
  DrawPass pass(frame, "shadow_culling_view", program);
  pass.read("unculled", unculled);
  pass.read("drawn", drawn);
  pass.read("closeups", closeups == nullptr ? ImageRef{} : closeups->visibility);
  add_visualizer_targets(frame, pass, std::string(kUnculled), gpu::Format::rgba32_float, gpu::LoadOp::clear);
  pass.draw_triangle();
}

}  // namespace

std::vector<VisualizerInfo> unculled_visualizers() {
  const std::string colors =
      ": black unlit, white fully lit, blue out of the light's reach; where the drawn visibility differs: red drawn "
      "darker, cyan drawn brighter";
  std::vector<VisualizerInfo> views = {
      {std::string(kUnculled), "shadows", "LIGHT",
       "visibility of the light evaluated again at every pixel, from its maps and close-up maps, without lists, masks "
       "and classification" +
           colors},
      {std::string(kFiltered), "shadows", "LIGHT",
       "as shadow_unculled, with the filter of the standard maps run also where its search finds that nothing or "
       "everything blocks" +
           colors}};
  for (VisualizerInfo& view : views) {
    view.knob = kShadowMode.name;
    view.value = text_of(kShadowMode, ShadowMode::deferred);
    view.image = kUnculled;
    view.shows_lists = true;
  }
  return views;
}

void add_unculled_view_passes(FrameBuilder& frame, OnceLog& once_log) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = shown.substr(0, shown.find(':'));
  if ((stem != kUnculled && stem != kFiltered) || frame.find<ShadowsOutputs>() == nullptr) return;
  if (find_final_lists(frame) == nullptr) {
    once_log.warning(frame.log(),
                     "view " + std::string(shown) + " shows the picture as it is: " + reason_without_lists(frame));
    return;
  }
  const auto light = shown_light_or_warn(frame, once_log);
  if (!light) return;
  const ShadowsOutputs shadows = frame.get<ShadowsOutputs>();
  ShadowsOutputs standard = shadows;
  standard.rows = shadows.standard_rows;
  DrawProgram from_maps{shaders::shadows::unculled_view_frag, shadows.constants};
  from_maps.constants.set("kFilterAll", stem == kFiltered ? 1u : 0u);
  const ImageRef unculled = visibility_of(frame, *light, standard, "shadow_from_maps", std::move(from_maps));
  const ImageRef drawn = visibility_of(frame, *light, shadows, "shadow_visibility",
                                       drawn_visibility_program(shadows, shaders::shadows::visibility_view_frag,
                                                                shaders::shadows::final_visibility_view_frag));
  add_comparison(frame, unculled, drawn);
}

}  // namespace gloam
