// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_HEAT_GLSL
#define GLOAM_SHADERS_COMMON_HEAT_GLSL

// Heat scale in linear RGB for a value in 0…1: black, blue, cyan, green, yellow, red; white above 1.
vec3 heat(float share) {
  const vec3 stops[6] = vec3[](vec3(0.0), vec3(0.02, 0.05, 0.6), vec3(0.0, 0.45, 0.6), vec3(0.05, 0.5, 0.05),
                               vec3(0.8, 0.6, 0.0), vec3(0.8, 0.02, 0.02));
  if (share > 1.0) return vec3(1.0);
  float at = clamp(share, 0.0, 1.0) * 5.0;
  int low = min(int(at), 4);
  return mix(stops[low], stops[low + 1], at - float(low));
}

#endif
