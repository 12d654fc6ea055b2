// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/proxies/proxies_api.glsl"

// Ray i against proxy i.
layout(local_size_x = 64) in;

struct TestRay {
  vec3 origin;
  vec3 direction;
};
struct TestHit {
  vec2 uv;
  float distance_m;
  uint met;
  uint sphere;
  uint served;
};
layout(set = 0, binding = 0, scalar) readonly buffer Proxies { ProxyRow proxies[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Rays { TestRay rays[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Hits { TestHit hits[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  ProxyHit hit = meet_proxy(proxies[i], rays[i].origin, rays[i].direction);
  hits[i] = TestHit(hit.uv, hit.distance_m, hit.met ? 1u : 0u,
                    meets_sphere(proxies[i], rays[i].origin, rays[i].direction) ? 1u : 0u,
                    serves_height(proxies[i], rays[i].origin.y) ? 1u : 0u);
}
