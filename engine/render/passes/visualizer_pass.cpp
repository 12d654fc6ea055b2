// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <algorithm>
#include <cmath>
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

std::vector<HeatTick> heat_ticks(const HeatScale& scale, float heat_range) {
  constexpr int kSteps = GLOAM_HEAT_STOPS - 1;
  constexpr double kRounding = 1e-5;  // of the range, which is a float
  const double end = scale.most * static_cast<double>(heat_range);
  double step = end / kSteps;
  if (scale.counts) step = std::max(1.0, std::ceil(step * (1.0 - kRounding)));
  std::vector<HeatTick> ticks;
  for (int i = 0; i <= kSteps && i * step <= end * (1.0 + kRounding); ++i)
    ticks.push_back(
        {std::min(i * step / end, 1.0), scale.counts ? formatted("%.0f", i * step) : formatted("%.3g", i * step)});
  if (!scale.unit.empty()) ticks.back().text += " " + scale.unit;
  return ticks;
}

vec3 heat_color(double share) {
  constexpr vec3 kStops[GLOAM_HEAT_STOPS] = {GLOAM_HEAT_COLORS};
  if (share > 1.0) return vec3(1.0f);
  const double at = std::clamp(share, 0.0, 1.0) * (GLOAM_HEAT_STOPS - 1);
  const int low = std::min(static_cast<int>(at), GLOAM_HEAT_STOPS - 2);
  return glm::mix(kStops[low], kStops[low + 1], static_cast<float>(at - low));
}

}  // namespace gloam
