// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "tests/shaders/lighting_test/surfaces.glsl"

// Linear light plus the specular ambient term.

layout(set = 0, binding = 5) uniform sampler2D lit_image;
layout(set = 0, binding = 6, scalar) uniform Environment { EnvironmentConstants environment; };

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 light = texelFetch(lit_image, pixel, 0);
  if (!is_sky(pixel)) {
    GBufferTexel g = surface_at(pixel);
    light.rgb += g.occlusion * specular_ambient(environment, point_at(pixel, g), g.roughness);
  }
  out_light = light;
}
