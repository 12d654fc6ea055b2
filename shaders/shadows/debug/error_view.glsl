// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_ERROR_VIEW_GLSL
#define GLOAM_SHADERS_SHADOWS_ERROR_VIEW_GLSL

// Visualizer error: the mean absolute difference between drawn and traced visibility, over the traced lights that reach
// the surface and that it faces, or that it lets through from behind. See drawn_visibility.glsl.

#define GLOAM_SHADOWS_BINDING 6
#define GLOAM_SMOOTH_SURFACE_BINDING 20
#include "shaders/common/heat.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/shadows_api.glsl"
#include "shaders/shadows/debug/drawn_visibility.glsl"

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the picture's format does not encode sRGB

const float kWhite = 0.5;  // difference that is shown white

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D base_color_image;
layout(set = 0, binding = 5) uniform sampler2D light_texels;
layout(set = 0, binding = 21) uniform sampler2D emissive_image;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_difference;

// x: sum of the differences; y: their number.
vec2 local_differences(uvec2 pixel, vec3 position, vec3 normal, ShadowReceiver r, float extinction_m) {
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < lights.local_count; ++i) {
    LocalLight light = fetch_light(light_texels, i);
    light.color = vec3(1.0);  // only the light's reach matters, not its strength
    vec3 to_light;
    float layer = texelFetch(shadow_rows, ivec2(6, i), 0).z;
    bool counts = layer >= 0.0 && local_illuminance(light, position, to_light).x > 0.0;
    float behind = extinction_behind(extinction_m, normal, to_light);
    counts = counts && (dot(normal, to_light) > 0.0 || behind > 0.0);
    for (; counts; counts = false)
      sum +=
          vec2(abs(drawn_visibility(pixel, false, i, light.position, r, true, behind) - traced_visibility(layer)), 1.0);
  }
  return sum;
}

vec2 directional_differences(uvec2 pixel, vec3 normal, ShadowReceiver r, float extinction_m) {
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < lights.directional_count; ++i) {
    float layer = shadow_block.directional[i].traced_layer;
    vec3 direction = lights.directional[i].direction;
    float behind = extinction_behind(extinction_m, normal, -direction);
    bool counts = layer >= 0.0 && (dot(normal, -direction) > 0.0 || behind > 0.0);
    for (; counts; counts = false)
      sum += vec2(abs(drawn_visibility(pixel, true, i, direction, r, true, behind) - traced_visibility(layer)), 1.0);
  }
  return sum;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-30));
  uvec2 normals = texelFetch(normal_image, pixel, 0).xy;
  vec3 normal = unpack_normal(normals.x);
  float alpha = texelFetch(base_color_image, pixel, 0).a;
  ShadowReceiver r = pixel_receiver(position, unpack_normal(normals.y), alpha > 0.5, pixel);
  r.thin = is_thin(alpha);
  float extinction_m = 0.0;
  if (kTransmission != 0u) extinction_m = decode_extinction(texelFetch(emissive_image, pixel, 0).a);
  vec2 sum = vec2(0.0);
  if (depth > 0.0)
    sum = local_differences(uvec2(pixel), position, normal, r, extinction_m) +
          directional_differences(uvec2(pixel), normal, r, extinction_m);
  float difference = sum.y > 0.0 ? sum.x / sum.y : -1.0;
  vec3 color = heat(max(difference, 0.0) / kWhite);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_difference = vec4(difference, 0.0, 0.0, 1.0);
}

#endif
