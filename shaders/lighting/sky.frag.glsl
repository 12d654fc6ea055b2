// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/render/view_api.glsl"

// Radiance of the pixels without a surface.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };

layout(constant_id = 4) const uint kDiffuseLight = 0u;  // 1: with the second target

layout(location = 0) out vec4 out_light;
layout(location = 1) out vec4 out_diffuse_light;

void main() {
  vec3 position = relative_position(view, gl_FragCoord.xy - 0.5, 0.5);
  vec3 to_eye = normalize(to_viewer(view, position));
  out_light = vec4(min(sky_radiance(environment, -to_eye), vec3(65504.0)), 1.0);
  if (kDiffuseLight != 0u) out_diffuse_light = vec4(0.0, 0.0, 0.0, 1.0);
}
