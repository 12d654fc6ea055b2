// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHTS_API_GLSL
#define GLOAM_SHADERS_LIGHTS_LIGHTS_API_GLSL

#include "shaders/lights/lights_shared.h"

// Reads a local light from its row of three texels, which light_texels.comp writes.
LocalLight fetch_light(sampler2D texels, uint index) {
  vec4 a = texelFetch(texels, ivec2(0, index), 0);
  vec4 b = texelFetch(texels, ivec2(1, index), 0);
  vec4 c = texelFetch(texels, ivec2(2, index), 0);
  return LocalLight(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w);
}

// The window by which a light ends at its range, as KHR_lights_punctual recommends: 1 - (distance / range)^4, at least
// 0. squared_share: (distance / range)^2.
float range_window(float squared_share) { return clamp(1.0 - squared_share * squared_share, 0.0, 1.0); }

// Illuminance, in lux, from a local light at a camera-relative point on a plane that faces the light. `to_light`: the
// unit direction to the light. Inverse square, multiplied by the window of the range and by the spot's falloff.
vec3 local_illuminance(LocalLight light, vec3 point, out vec3 to_light) {
  vec3 offset = light.position - point;
  float d2 = max(dot(offset, offset), 1e-30);
  float inverse_distance = inversesqrt(d2);
  to_light = offset * inverse_distance;
  float window = range_window(d2 * light.inverse_range_squared);
  float cone = clamp(dot(-to_light, light.direction) * light.spot_scale + light.spot_offset, 0.0, 1.0);
  return min(light.color * (window * cone * cone * inverse_distance * inverse_distance), vec3(1e30));
}

#endif
