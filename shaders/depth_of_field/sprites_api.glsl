// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_SPRITES_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_SPRITES_API_GLSL

#include "shaders/depth_of_field/coc_api.glsl"

// Pixels that are much brighter than their surroundings are drawn as sprites. Include this after the uniform `dof`.

float brightness(vec3 light) { return max(light.r, max(light.g, light.b)); }

// Share of a pixel's light that its sprite takes; 0: it has none. A pixel is bright enough if its light, spread over
// its circle, still shows beside the surroundings. surroundings: of its tile (DofTileSprites).
float sprite_share(vec3 light, float coc, float surroundings) {
  float bright = brightness(light), area = 3.2 * coc * coc;
  bool is_sprite =
      surroundings >= 0.0 && abs(coc) >= kInFocus && bright > 1e-6 && bright > surroundings * (40.0 + 0.05 * area);
  return is_sprite ? 1.0 - surroundings / bright : 0.0;
}

#endif
