// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_HEAT_GLSL
#define GLOAM_SHADERS_COMMON_HEAT_GLSL

#include "shaders/common/heat_shared.h"

layout(constant_id = 99) const float kHeatRange = 1.0;  // factor on the value at the scale's end

// The colour at a position of the heat scale, 0…1.
vec3 heat_color(float share) {
  const vec3 stops[GLOAM_HEAT_STOPS] = vec3[](GLOAM_HEAT_COLORS);
  float at = clamp(share, 0.0, 1.0) * float(GLOAM_HEAT_STOPS - 1);
  int low = min(int(at), GLOAM_HEAT_STOPS - 2);
  return share > 1.0 ? vec3(1.0) : mix(stops[low], stops[low + 1], at - float(low));
}

// The colour of a value, as a share of the value at the end of the visualizer's usual scale.
vec3 heat(float share) { return heat_color(share / kHeatRange); }

#endif
