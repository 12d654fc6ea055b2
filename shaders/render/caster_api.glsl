// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_CASTER_API_GLSL
#define GLOAM_SHADERS_RENDER_CASTER_API_GLSL

#include "shaders/render/caster_shared.h"

// Clip-space position of a caster's vertex in a map. In an orthographic face, vertices in front of the near side are
// moved onto it, so that they still cast shadows.
vec4 caster_position(CasterConstants caster, vec3 position) {
  vec4 clip = caster.clip_from_local * vec4(position, 1.0);
  if (caster.orthographic != 0u) clip.z = min(clip.z, 1.0);
  return clip;
}

#endif
