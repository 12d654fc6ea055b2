// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/reference_visualizers.h"

#include <span>
#include <string>

#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/debug/visualizers.h"
#include "modules/shadows/filter/uploads.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/reference/adapter.h"
#include "shaders/shadows/shaders.h"

namespace gloam {

std::vector<VisualizerInfo> shadow_reference_visualizers() {
  std::vector<VisualizerInfo> views = {{"shadow_reference", "shadows", "LIGHT",
                                        "traced visibility of the light at each pixel: black unlit, white fully lit, "
                                        "grey between (linear: 0.5 is 188 in "
                                        "the picture), blue out of the light's reach"},
                                       {"error", "shadows", "",
                                        "difference between drawn and traced visibility, mean over the lights that "
                                        "reach and face the pixel"}};
  for (VisualizerInfo& view : views) {
    view.knob = kShadowMode.name;
    view.value = texts_of(kShadowMode, {ShadowMode::monolithic, ShadowMode::deferred});
    view.trace = put_traced_visibility;
  }
  views.back().image = "shadow_error";
  views.back().heat = {0.5};
  return views;
}

void add_shadow_reference_view_pass(FrameBuilder& frame, OnceLog& once_log) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = shown.substr(0, shown.find(':'));
  if (stem != "shadow_reference" && stem != "error") return;
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  if (shadows == nullptr) return;
  if (traced_visibility_of(frame.world(), frame.view()) == nullptr)
    return frame.fail({ErrorKind::usage,
                       "view " + std::string(stem) + " needs traced visibility, which only `gloam render` computes"});
  if (stem == "error") {
    draw_shadow_picture(frame, {.pass = "shadow_error_view",
                                .values = "shadow_error",
                                .program = drawn_visibility_program(*shadows, shaders::shadows::error_view_frag,
                                                                    shaders::shadows::final_error_view_frag)});
  } else if (const auto light = shown_light_or_warn(frame, once_log)) {
    // The shader of visualizer "shadow", with the constants for traced visibility.
    const auto constants = shadow_constants(shadow_knobs(frame.knobs()), kTracedShadows);
    draw_shadow_picture(frame, {.pass = "shadow_reference_view",
                                .values = "shadow_reference",
                                .program = {shaders::shadows::visibility_view_frag, constants},
                                .push = std::as_bytes(std::span(&*light, 1))});
  }
}

}  // namespace gloam
