// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ARRIVING_LIGHT_GLSL
#define GLOAM_SHADERS_LIGHTING_ARRIVING_LIGHT_GLSL

// What shadows and cookies leave of a light's illuminance. Without GLOAM_SHADOWS_BINDING (the first of six bindings, see shadows_api.glsl)
// everything arrives.

#ifdef GLOAM_SHADOWS_BINDING
#include "shaders/shadows/shadows_api.glsl"

ShadowReceiver receiver;  // the shaded surface; set before lights are added up

void set_receiver(vec3 position, vec3 face_normal, bool subsurface) { receiver = ShadowReceiver(position, face_normal, subsurface); }

bool gives_light(vec3 illuminance, vec3 normal, vec3 to_light) {
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 && dot(normal, to_light) > 0.0;
}

// See shadow_space.glsl.
bool never() { return shadow_block.atlas_size < 0.0; }

vec3 arriving_local(vec3 illuminance, uint light, vec3 light_position, vec3 normal, vec3 to_light) {
  if (gives_light(illuminance, normal, to_light)) do {
    illuminance *= cookie_color(light, light_position, receiver) * local_visibility(light, light_position, receiver);
  } while (never());
  return illuminance;
}

vec3 arriving_directional(vec3 illuminance, uint light, vec3 light_direction, vec3 normal) {
  if (gives_light(illuminance, normal, -light_direction)) do {
    illuminance *= directional_visibility(light, light_direction, receiver);
  } while (never());
  return illuminance;
}
#else
void set_receiver(vec3 position, vec3 face_normal, bool subsurface) {}
vec3 arriving_local(vec3 illuminance, uint light, vec3 light_position, vec3 normal, vec3 to_light) { return illuminance; }
vec3 arriving_directional(vec3 illuminance, uint light, vec3 light_direction, vec3 normal) { return illuminance; }
#endif

#endif
