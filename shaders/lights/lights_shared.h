// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H
#define GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_MAX_LOCAL_LIGHTS 1024
#define GLOAM_MAX_DIRECTIONAL_LIGHTS 16
#define GLOAM_LIGHT_GROUPS 32   // words of 32 lights in a tile's mask; one more layer tells which words are not empty

GLOAM_SHARED_BEGIN

/// A point or spot light, camera-relative.
struct LocalLight {
  vec3 position;
  float inverse_range_squared;
  vec3 color;            // candela, linear
  float spot_scale;      // strength = clamp(cos * scale + offset)²; a point light has 0 and 1
  vec3 direction;        // where it shines, unit
  float spot_offset;
};

struct DirectionalLight {
  vec3 color;            // lux, linear
  float apparent_angle;  // radians
  vec3 direction;        // where it shines, unit
  float reserved;
};

/// Lights that may touch the view: local ones ordered by nearest view depth of their bounds.
struct LightBlock {
  uint local_count;
  uint directional_count;
  uint reserved0;
  uint reserved1;
  DirectionalLight directional[GLOAM_MAX_DIRECTIONAL_LIGHTS];
  LocalLight local[GLOAM_MAX_LOCAL_LIGHTS];
};

GLOAM_SHARED_END

#endif
