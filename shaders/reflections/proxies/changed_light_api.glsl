// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_CHANGED_LIGHT_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_CHANGED_LIGHT_API_GLSL

#include "shaders/lights/lights_api.glsl"

// Ratio of a receiver's diffuse light to what it was when proxies and probes were captured. Only the lights that have
// changed since are summed, without shadows: with all lights as captured the ratio is exactly 1. Include this after the
// uniform `reflection` and the buffer `changed_lights`.

// Illuminance, on a surface with this normal, that a light has lost since the capture.
vec3 missing_light(ChangedLight changed, vec3 position, vec3 normal) {
  vec3 to_light;
  LocalLight light = LocalLight(changed.position, changed.inverse_range_squared, changed.missing, changed.spot_scale,
                                changed.direction, changed.spot_offset);
  vec3 local = local_illuminance(light, position, to_light);
  if (changed.directional > 0.5) {
    local = changed.missing;
    to_light = -changed.direction;
  }
  return local * clamp(dot(normal, to_light), 0.0, 1.0);
}

const float kMostRatio = 8.0;

// now: the receiver's diffuse light, lux.
float diffuse_light_ratio(vec3 now, vec3 position, vec3 normal) {
  vec3 missing = vec3(0.0);
  for (uint i = 0u; i < reflection.changed_lights; ++i) missing += missing_light(changed_lights[i], position, normal);
  float current = dot(now, vec3(0.2126, 0.7152, 0.0722)), lost = dot(missing, vec3(0.2126, 0.7152, 0.0722));
  float captured = max(current + lost, current / kMostRatio);
  return lost == 0.0 || captured <= 0.0 ? 1.0 : clamp(current / captured, 0.0, kMostRatio);
}

#endif
