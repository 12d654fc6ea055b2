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
layout(constant_id = 1) const uint kPaths = 0u;       // 1: emitters of the dispatch have paths

layout(push_constant, scalar) uniform Constants { ParticleDispatch c; };

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Frame { ParticleFrame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer Emitters { ParticleEmitterRow emitters[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Groups { uint emitter_of_group[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Particles { Particle particles[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Poses { ParticlePose poses[]; };

// Puts the emitter where it was when a particle of this age was born. Returns its velocity then.
vec3 move_to_birth(inout ParticleEmitterRow e, float age) {
  uint older = e.path_first, younger = e.path_first + e.path_poses - 1u;
  for (int i = 0; i < 8; ++i) {  // 256 poses
    uint middle = (older + younger) / 2u;
    if (poses[middle].age_s > age)
      older = middle;
    else
      younger = max(middle, older);
  }
  ParticlePose a = poses[older], b = poses[younger];
  float between = a.age_s - b.age_s;
  float share = clamp((a.age_s - age) / max(between, 1e-6), 0.0, 1.0);
  e.origin = mix(a.origin, b.origin, share);
  e.box_x = mix(a.box_x, b.box_x, share);
  e.box_y = mix(a.box_y, b.box_y, share);
  e.box_z = mix(a.box_z, b.box_z, share);
  vec3 axis = mix(a.axis, b.axis, share);
  e.axis = dot(axis, axis) > 1e-6 ? normalize(axis) : b.axis;
  vec3 other = abs(e.axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
  e.across_x = normalize(cross(other, e.axis));
  e.across_y = cross(e.axis, e.across_x);
  return between > 1e-5 ? (b.origin - a.origin) / between : vec3(0.0);
}

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
  uint live = min(k, e.count - 1u);
  vec3 carried = vec3(0.0);
  if (kPaths != 0u && e.path_poses > 0u) carried = move_to_birth(e, particle_age(e, live));
  Particle p = particle_state(e, row, live, carried);
  float depth_m = view_depth(view, p.position);
  p.opacity *= near_fade(depth_m, p.radius_m);
  uint key = frame.culled_key;
  if (k < e.count && in_view(p, depth_m))
    key = e.first_key + min(uint(max((e.far_m - depth_m) * e.keys_per_m, 0.0)), e.keys - 1u);
  particles[place] = p;
  keys[place] = key;
}
