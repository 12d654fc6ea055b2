// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAP_POSITION_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAP_POSITION_GLSL

#include "shaders/shadows/maps/map_shared.h"

// Where a vertex lies in the map. What stands before the near side of a directional light's box still casts its shadow
// into it.
vec4 map_position(ShadowDrawConstants draw, vec3 position) {
  vec4 clip = draw.clip_from_mesh * vec4(position, 1.0);
  if (draw.orthographic != 0u) clip.z = min(clip.z, 1.0);
  return clip;
}

#endif
