// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_COOKIES_GLSL
#define GLOAM_SHADERS_SHADOWS_COOKIES_GLSL

// Evaluates cookies. Included by shadows_api.glsl and cookies_api.glsl, which declare shadow_block, shadow_rows and
// shadow_cookies.

// The direction in which a spot shines. The axes of a mirrored node are left-handed, so the cross product is negated.
vec3 spot_forward(uint light, vec3 right, vec3 up) {
  vec3 forward = cross(up, right);
  return texelFetch(shadow_rows, ivec2(6, light), 0).w > 0.5 ? -forward : forward;
}

// The factor by which a spot light's cookie filters its light at a position: white without a cookie. Positions beyond
// its square get the colour of its border.
vec3 cookie_color(uint light, vec3 light_position, vec3 position) {
  vec2 cookie = texelFetch(shadow_rows, ivec2(6, light), 0).xy;  // layer, tangent
  vec3 color = vec3(1.0);
  if (cookie.x >= 0.0) {
    vec3 right = texelFetch(shadow_rows, ivec2(1, light), 0).xyz;
    vec3 up = texelFetch(shadow_rows, ivec2(2, light), 0).xyz;
    vec3 v = position - light_position;
    float z = max(dot(v, spot_forward(light, right, up)), 1e-6);
    vec2 tangent = clamp(vec2(dot(v, right), -dot(v, up)) / (z * cookie.y), -1.0, 1.0);
    color = textureLod(shadow_cookies, vec3(tangent * 0.5 + 0.5, cookie.x), 0.0).rgb;
  }
  return color;
}

#endif
