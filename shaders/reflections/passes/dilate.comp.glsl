// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// One direction of the dilation of spreads: a texel takes the greatest spread of all texels whose blur's core reaches
// it, so that blurred things have no sharp silhouette. A sharp contact stays sharp, because its neighbours' blur is
// narrow.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D spread_image;   // x
layout(set = 0, binding = 3) uniform sampler2D surface_image;  // y: roughness; 0: the texel does not reflect
layout(set = 0, binding = 4, r8) uniform writeonly image2D dilated_image;

#include "shaders/reflections/passes/blur_lines.glsl"

shared vec2 segment[kSegment];  // spread, reach in texels
shared uint most;               // greatest reach of the segment

void load(int i) {
  ivec2 texel = segment_texel(i);
  vec2 loaded = vec2(0.0, -1.0);
  if (is_inside(texel)) {
    float roughness = texelFetch(surface_image, texel, 0).y;
    loaded.x = texelFetch(spread_image, texel, 0).x;
    if (roughness > 0.0) loaded.y = float(widest_reach(blur_sigma(texel, loaded.x, roughness)));
  }
  segment[i] = loaded;
  if (loaded.y > 0.0) atomicMax(most, uint(loaded.y));
}

void main() {
  int own = int(gl_LocalInvocationIndex);
  if (own == 0) most = 0u;
  barrier();
  for (int i = 0; i < GLOAM_BLUR_GROUP + 2 * int(reflection.blur_radius); i += GLOAM_BLUR_GROUP) load(own + i);
  barrier();
  own += int(reflection.blur_radius);
  float spread = segment[own].x;
  int reach = int(most);
  for (int k = -reach; k <= reach; ++k) {
    vec2 other = segment[own + k];
    spread = float(abs(k)) <= other.y ? max(spread, other.x) : spread;
  }
  ivec2 texel = segment_texel(own);
  if (is_inside(texel)) imageStore(dilated_image, texel, vec4(segment[own].y >= 0.0 ? spread : 0.0));
}
