// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_API_GLSL
#define GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_API_GLSL

// Bindings and helpers of the close-up visualizers.

#include "shaders/closeups/closeup_views_shared.h"
#include "shaders/lights/light_views_api.glsl"
#include "shaders/render/view_api.glsl"

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) readonly buffer Closeups { ShownCloseup closeups[]; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;

layout(push_constant, scalar) uniform Push { uint closeup_count; };

bool in_tiles(ShownCloseup closeup, uvec2 pixel) {
  uvec2 tile = pixel / uint(GLOAM_SHADOW_TILE);
  return all(greaterThanEqual(tile, closeup.first_tile)) && all(lessThan(tile, closeup.end_tile));
}

#endif
