// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

// Lights the sprites at their middles or at their corners, in the order in which they are drawn. One thread for each
// sprite. Shared by light.comp and light_cookies.comp.

#include "shaders/particles/particles_shared.h"
#include "shaders/render/view_api.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kLitPoints = 4u;  // 1: the middle, 4: the corners

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Frame { ParticleFrame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer Emitters { ParticleEmitterRow emitters[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Particles { Particle particles[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Draws { ParticleDraws draws; };
layout(set = 0, binding = 6, scalar) writeonly buffer Light { uvec2 light[]; };  // four half floats

#define GLOAM_PARTICLE_LIGHT_BINDING 7
#include "shaders/particles/lighting/scattered_light.glsl"

// Light for a corner is summed on the way to it: at the corner the sprite is transparent, and there may be a lamp.
const float kLitCorner = 0.6;

void main() {
  uint sprite = gl_GlobalInvocationID.y * (32768u * 64u) + gl_GlobalInvocationID.x;
  if (sprite >= draws.drawn) return;
  Particle p = particles[order[sprite]];
  ParticleEmitterRow e = emitters[p.look & 0xFFFFu];
  for (uint i = 0u; i < kLitPoints; ++i) {
    vec2 corner = kLitPoints == 1u ? vec2(0.0) : (vec2(i & 1u, i >> 1u) * 2.0 - 1.0) * kLitCorner;
    vec3 at = p.position + p.radius_m * (corner.x * frame.right + corner.y * frame.up);
    vec3 sum = scattered_light(e, at, outward_direction(p.outward, corner));
    light[sprite * kLitPoints + i] = uvec2(packHalf2x16(sum.rg), packHalf2x16(vec2(sum.b, 0.0)));
  }
}
