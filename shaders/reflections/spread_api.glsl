// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_SPREAD_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_SPREAD_API_GLSL

#include "shaders/reflections/mirror_surface_api.glsl"

// Spread of a reflection, 0…1, which the glossy blur follows. Include this after the uniforms `view` and `reflection`.

// Screen-space distance between the surface and what it reflects, as in listing 1.2 of the paper; 1 if the hit is not
// in front of the near plane.
float screen_distance(MirrorSurface s, float distance_m) {
  vec4 at = view.clip_from_relative * vec4(s.position, 1.0);
  vec4 hit = view.clip_from_relative * vec4(s.position + s.direction * distance_m, 1.0);
  if (view.orthographic == 0u && hit.w <= view.near_m) return 1.0;
  return clamp(length(hit.xy / hit.w - at.xy / at.w), 0.0, 1.0);
}

// How far behind the mirror the reflected point appears, as a share of its distance from the eye. A lobe of a given
// angle covers an angle in the picture that is proportional to it. Orthographic: as a share of the picture's height,
// because the lobe covers a length that is proportional to the distance alone.
float mirrored_share(MirrorSurface s, float distance_m) {
  float whole_m = distance_m + length(s.position);
  if (view.orthographic != 0u) whole_m = length(view.ray_dy.xyz) * float(view.size.y);
  return clamp(distance_m / max(whole_m, 1e-30), 0.0, 1.0);
}

#endif
