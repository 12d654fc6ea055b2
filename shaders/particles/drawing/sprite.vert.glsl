// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/particles/particles_shared.h"
#include "shaders/render/view_api.glsl"

// Sprites that face the camera: squares parallel to the picture's plane. An instance has
// GLOAM_PARTICLE_DRAW_SPRITES sprites, because devices draw instances of four vertices slowly.

layout(constant_id = 0) const uint kLitPoints = 4u;  // 0: not lit here

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Frame { ParticleFrame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer Emitters { ParticleEmitterRow emitters[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Particles { Particle particles[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Draws { ParticleDraws draws; };
layout(set = 0, binding = 6, scalar) readonly buffer Light { uvec2 light[]; };

layout(location = 0) out vec4 out_corner;  // place in the sprite, place in its noise
layout(location = 1) out vec3 out_light;
layout(location = 2) out vec3 out_relative;
layout(location = 3) flat out vec4 out_look;      // opacity, view depth, 1 / fade distance, cover
layout(location = 4) flat out vec4 out_emission;  // and erosion
layout(location = 5) flat out uint out_outward;
layout(location = 6) flat out uint out_emitter;

vec3 light_of(uint sprite, uint corner) {
  if (kLitPoints == 0u) return frame.unlit;
  uvec2 packed_light = light[sprite * kLitPoints + (kLitPoints == 1u ? 0u : corner)];
  return vec3(unpackHalf2x16(packed_light.x), unpackHalf2x16(packed_light.y).x);
}

void main() {
  uint sprite = gl_InstanceIndex * GLOAM_PARTICLE_DRAW_SPRITES + gl_VertexIndex / 4u;
  uint index = gl_VertexIndex & 3u;
  bool exists = sprite < draws.drawn;
  uint last = exists ? sprite : 0u;
  Particle p = particles[order[last]];
  ParticleEmitterRow e = emitters[p.look & 0xFFFFu];
  vec2 corner = vec2(index & 1u, index >> 1u) * 2.0 - 1.0;
  vec3 relative = p.position + p.radius_m * (corner.x * frame.right + corner.y * frame.up);
  gl_Position = exists ? view.clip_from_relative * vec4(relative, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
  float c = cos(p.angle), s = sin(p.angle);
  uint lot = p.look >> 16u;
  vec2 noise_at = vec2(c * corner.x - s * corner.y, s * corner.x + c * corner.y) + vec2(lot & 0xFFu, lot >> 8u) * 0.173;
  out_corner = vec4(corner, noise_at);
  out_light = light_of(last, index);
  if (kLitPoints == 0u) out_light *= e.albedo;
  out_relative = relative;
  out_look = vec4(p.opacity, view_depth(view, p.position), 1.0 / max(0.7 * p.radius_m, 1e-4), e.cover);
  out_emission = vec4(e.emission * mix(vec3(1.0), e.cooled, p.life * p.life), e.erosion);
  out_outward = p.outward;
  out_emitter = p.look & 0xFFFFu;
}
