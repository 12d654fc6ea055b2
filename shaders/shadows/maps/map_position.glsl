// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAP_POSITION_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAP_POSITION_GLSL

#include "shaders/shadows/maps/map_shared.h"

// Clip-space position of a vertex in the map. In an orthographic face, vertices in front of the near side are moved
// onto it, so that they still cast shadows.
vec4 map_position(ShadowDrawConstants draw, vec3 position) {
  vec4 clip = draw.clip_from_mesh * vec4(position, 1.0);
  if (draw.orthographic != 0u) clip.z = min(clip.z, 1.0);
  return clip;
}

#endif
