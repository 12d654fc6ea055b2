// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <algorithm>
#include <utility>

#include "engine/core/text/formatted.h"
#include "shaders/common/heat_shared.h"

namespace gloam {

ImageRef add_visualizer_targets(FrameBuilder& frame, DrawPass& pass, std::string name, gpu::Format values,
                                gpu::LoadOp picture) {
  ImageRef& color = frame.get<TargetOutput>().color;
  color = pass.target(color, picture);
  const ImageRef written = pass.target(create_view_image(frame, std::move(name), values), gpu::LoadOp::clear);
  frame.expose(written);
  return written;
}

gpu::SpecConstants visualizer_constants(FrameBuilder& frame) {
  gpu::SpecConstants constants;
  constants.set("kEncode", gpu::encodes_srgb(frame.get<TargetOutput>().format) ? 0u : 1u);
  constants.set_if_present("kHeatRange", frame.heat_range());
  return constants;
}

double heat_value(const HeatScale& scale, float heat_range, int stop) {
  return scale.most * static_cast<double>(heat_range) * stop / (GLOAM_HEAT_STOPS - 1);
}

std::string heat_number(double value) { return formatted("%.3g", value); }

std::string heat_text(const HeatScale& scale, float heat_range) {
  constexpr const char* kNames[GLOAM_HEAT_STOPS] = {"black", "blue", "cyan", "green", "yellow", "red"};
  std::string text;
  for (int stop = 0; stop < GLOAM_HEAT_STOPS; ++stop)
    text += std::string(kNames[stop]) + " " + heat_number(heat_value(scale, heat_range, stop)) + ", ";
  return text + "white more" + (scale.unit.empty() ? "" : " " + scale.unit);
}

vec3 heat_color(double share) {
  constexpr vec3 kStops[GLOAM_HEAT_STOPS] = {GLOAM_HEAT_COLORS};
  if (share > 1.0) return vec3(1.0f);
  const double at = std::clamp(share, 0.0, 1.0) * (GLOAM_HEAT_STOPS - 1);
  const int low = std::min(static_cast<int>(at), GLOAM_HEAT_STOPS - 2);
  return glm::mix(kStops[low], kStops[low + 1], static_cast<float>(at - low));
}

}  // namespace gloam
