// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/particles/simulation/motion_api.glsl"
#include "shaders/render/view_api.glsl"

// Places the particles of a view's emitters and gives each a sort key: far particles have low keys. A workgroup has
// particles of one emitter. Emitters of many particles have a dispatch each: software devices read the row of all
// threads at once if its index is the same in the whole dispatch.

layout(local_size_x = 64) in;  // GLOAM_PARTICLE_GROUP

layout(constant_id = 0) const uint kOneEmitter = 0u;  // 1: the dispatch has particles of emitter c.row

layout(push_constant, scalar) uniform Constants { ParticleDispatch c; };

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Frame { ParticleFrame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer Emitters { ParticleEmitterRow emitters[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Groups { uint emitter_of_group[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Particles { Particle particles[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Keys { uint keys[]; };

// A sprite that comes near the camera fades out before the near plane cuts it.
float near_fade(float depth_m, float radius_m) {
  return clamp((depth_m - frame.near_m) / max(radius_m, 4.0 * frame.near_m), 0.0, 1.0);
}

bool in_view(Particle p, float depth_m) {
  bool inside = depth_m > frame.near_m && p.radius_m > 0.0 && p.opacity > 0.0;  // false for NaN
  for (int i = 0; i < 4; ++i)
    inside = inside && dot(frame.planes[i].xyz, p.position) + frame.planes[i].w >= -p.radius_m;
  return inside;
}

void main() {
  uint place = c.first_group * GLOAM_PARTICLE_GROUP + gl_GlobalInvocationID.x;
  uint row = c.row;
  if (kOneEmitter == 0u) row = emitter_of_group[c.first_group + gl_WorkGroupID.x];
  ParticleEmitterRow e = emitters[row];
  uint k = place - e.first;
  Particle p = particle_state(e, row, min(k, e.count - 1u));
  float depth_m = view_depth(view, p.position);
  p.opacity *= near_fade(depth_m, p.radius_m);
  uint key = frame.culled_key;
  if (k < e.count && in_view(p, depth_m))
    key = e.first_key + min(uint(max((e.far_m - depth_m) * e.keys_per_m, 0.0)), e.keys - 1u);
  particles[place] = p;
  keys[place] = key;
}
