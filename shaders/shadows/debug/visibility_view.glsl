// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_VISIBILITY_VIEW_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_VISIBILITY_VIEW_GLSL

// Visualizer shadow: the visibility of one light at each pixel. Black: unlit, white: fully lit, blue: the light does
// not reach the pixel. Transmittance where light from behind passes. See drawn_visibility.glsl. With GLOAM_UNCULLED,
// unculled_visibility.glsl.

#define GLOAM_SHADOWS_BINDING 6
#define GLOAM_SMOOTH_SURFACE_BINDING 20
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/maps/map_shared.h"
#include "shaders/shadows/shadows_api.glsl"
#ifdef GLOAM_UNCULLED
#include "shaders/shadows/debug/unculled_visibility.glsl"
#else
#include "shaders/shadows/debug/drawn_visibility.glsl"
#endif

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the picture's format does not encode sRGB

layout(push_constant, scalar) uniform Push { ShownLightConstants shown; };
layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D base_color_image;
layout(set = 0, binding = 5) uniform sampler2D light_texels;
layout(set = 0, binding = 21) uniform sampler2D emissive_image;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_visibility;

float visibility_at(uvec2 pixel, vec3 light_vector, ShadowReceiver r, bool faces, float extinction_m) {
#ifdef GLOAM_UNCULLED
  return unculled_visibility(shown.directional != 0u, shown.light, light_vector, r, faces, extinction_m);
#else
  return drawn_visibility(pixel, shown.directional != 0u, shown.light, light_vector, r, faces, extinction_m);
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-30));
  uvec2 normals = texelFetch(normal_image, pixel, 0).xy;
  float alpha = texelFetch(base_color_image, pixel, 0).a;
  ShadowReceiver r = pixel_receiver(position, unpack_normal(normals.y), alpha > 0.5, pixel);
  r.thin = is_thin(alpha);
  bool directional = shown.directional != 0u;
  LocalLight local = fetch_light(light_texels, directional ? 0u : shown.light);
  local.color = vec3(1.0);  // only the light's reach matters, not its strength
  vec3 to_light;
  bool reaches = directional || local_illuminance(local, position, to_light).x > 0.0;
  vec3 light_vector = directional ? lights.directional[directional ? shown.light : 0u].direction : local.position;
  vec3 normal = unpack_normal(normals.x), toward = directional ? -light_vector : to_light;
  float extinction = 0.0;
  if (kTransmission != 0u)
    extinction = extinction_behind(decode_extinction(texelFetch(emissive_image, pixel, 0).a), normal, toward);
  bool faces = dot(normal, toward) > 0.0 || extinction > 0.0;
  float visibility = depth > 0.0 && reaches ? visibility_at(uvec2(pixel), light_vector, r, faces, extinction) : -1.0;
  vec3 color = visibility < 0.0 ? vec3(0.0, 0.0, 0.04) : vec3(visibility);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_visibility = vec4(visibility, 0.0, 0.0, 1.0);
}

#endif
