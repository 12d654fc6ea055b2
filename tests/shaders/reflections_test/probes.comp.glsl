// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/probe_rows_api.glsl"

// Radiance of all probes for each ray.
layout(local_size_x = 64) in;

struct TestRay {
  vec3 position;
  float roughness;
  vec3 direction;
};
layout(set = 0, binding = 0, scalar) readonly buffer Rays { TestRay rays[]; };
layout(set = 0, binding = 1, scalar) readonly buffer ProbeRows { ProbeRow probe_rows[]; };
layout(set = 0, binding = 2) uniform sampler2DArray probe_images;
layout(set = 0, binding = 3, scalar) writeonly buffer Lights { vec4 lights[]; };  // radiance, covered share

layout(set = 0, binding = 4, scalar) readonly buffer CaptureFactors { vec4 capture_factors[]; };

layout(push_constant, scalar) uniform Push { uint probes; };

#include "shaders/lighting/probes_api.glsl"

void main() {
  TestRay ray = rays[gl_GlobalInvocationID.x];
  float covered;
  vec3 light = probes_radiance(probes, ray.position, ray.direction, ray.roughness, covered);
  lights[gl_GlobalInvocationID.x] = vec4(light, covered);
}
