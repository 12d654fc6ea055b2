// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ARRIVING_LIGHT_GLSL
#define GLOAM_SHADERS_LIGHTING_ARRIVING_LIGHT_GLSL

// Reduces a light's illuminance by shadows and cookies. Define GLOAM_SHADOWS_BINDING for both (the first of six
// bindings, see shadows_api.glsl), or GLOAM_COOKIES_BINDING for cookies only (the first of three, see
// cookies_api.glsl); without either, light arrives unchanged. Include this after `lights`, the view's LightBlock.

// Apparent radius of a local light, in radians, at a point from which it lies at `offset`.
float half_angle_of(uint light, vec3 offset) {
  float radius = lights.emitter_radius[light >> 2u][light & 3u];
  return radius > 0.0 ? min(radius * inversesqrt(max(dot(offset, offset), 1e-12)), 1.0) : 0.0;
}

#include "shaders/render/transmission_api.glsl"

// Extinction length of the shaded surface; 0: no light passes. Set before lights are summed.
float extinction_m = 0.0;

#ifdef GLOAM_SHADOWS_BINDING
#include "shaders/shadows/shadows_api.glsl"
#elif defined(GLOAM_COOKIES_BINDING)
#include "shaders/shadows/cookies_api.glsl"
#endif

#if defined(GLOAM_SHADOWS_BINDING) || defined(GLOAM_COOKIES_BINDING)
// Lights whose cookies are looked up once per surface, before the loop over its lights: devices that run both sides of
// a condition would look up a cookie for every light. If greater than GLOAM_COOKIE_LIGHTS, the cookie is looked up per
// light instead.
layout(constant_id = 18) const uint kCookieLights = GLOAM_COOKIE_LIGHTS + 1u;

vec3 receiver_position;
vec3 cookie_colors[GLOAM_COOKIE_LIGHTS];

void look_up_cookies(vec3 position) {
  receiver_position = position;
  for (uint i = 0u; i < kCookieLights && kCookieLights <= GLOAM_COOKIE_LIGHTS; ++i) {
    uint light = shadow_block.cookie_lights[i] < GLOAM_MAX_LOCAL_LIGHTS ? shadow_block.cookie_lights[i] : 0u;
    cookie_colors[i] = cookie_color(light, lights.local[light].position, position);
  }
}

vec3 through_cookie(vec3 illuminance, uint light, vec3 light_position) {
  if (kCookieLights > GLOAM_COOKIE_LIGHTS) return illuminance * cookie_color(light, light_position, receiver_position);
  for (uint i = 0u; i < kCookieLights; ++i)
    if (light == shadow_block.cookie_lights[i]) illuminance *= cookie_colors[i];
  return illuminance;
}
#else
void look_up_cookies(vec3 position) {}
vec3 through_cookie(vec3 illuminance, uint light, vec3 light_position) { return illuminance; }
#endif

#ifdef GLOAM_SHADOWS_BINDING
ShadowReceiver receiver;  // the shaded surface; set before lights are summed

void set_receiver(vec3 position, vec3 face_normal, bool subsurface) {
  receiver = drawn_receiver(position, face_normal, subsurface);
  look_up_cookies(position);
}

// Define GLOAM_LIGHT_FROM_BEHIND if the shader also uses light that arrives from behind the surface.
bool gives_light(vec3 illuminance, vec3 normal, vec3 to_light) {
#ifdef GLOAM_LIGHT_FROM_BEHIND
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0;
#else
  bool used = dot(normal, to_light) > 0.0 || extinction_behind(extinction_m, normal, to_light) > 0.0;
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 && used;
#endif
}

// Always false, see shaders/shadows/filter/space.glsl.
bool never() { return shadow_block.atlas_size < 0.0; }

vec3 arriving_local(vec3 illuminance, uint light, vec3 light_position, vec3 normal, vec3 to_light) {
  if (gives_light(illuminance, normal, to_light)) do {
      illuminance =
          through_cookie(illuminance, light, light_position) *
          local_visibility(light, light_position, receiver, extinction_behind(extinction_m, normal, to_light));
    } while (never());
  return illuminance;
}

vec3 arriving_directional(vec3 illuminance, uint light, vec3 light_direction, vec3 normal) {
  if (gives_light(illuminance, normal, -light_direction)) do {
      illuminance *= directional_visibility(light, light_direction, receiver,
                                            extinction_behind(extinction_m, normal, -light_direction));
    } while (never());
  return illuminance;
}
#else
void set_receiver(vec3 position, vec3 face_normal, bool subsurface) { look_up_cookies(position); }
vec3 arriving_local(vec3 illuminance, uint light, vec3 light_position, vec3 normal, vec3 to_light) {
  return through_cookie(illuminance, light, light_position);
}
vec3 arriving_directional(vec3 illuminance, uint light, vec3 light_direction, vec3 normal) { return illuminance; }
#endif

#endif
