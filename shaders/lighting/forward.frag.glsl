// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"

// Lights blended surfaces where they are drawn. They see every light of the view: tile masks know opaque depths only.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };

layout(location = 0) out vec4 out_light;

void main() {
  vec3 to_eye = normalize(to_viewer(view, in_relative));
  Surface s = fetch_surface(to_eye);
  ShadingPoint p = shading_point(in_relative, to_eye, s.normal, s.base_color.rgb, s.metallic, s.roughness);
  vec3 light = s.emissive + ambient(environment, p, s.roughness, s.occlusion);
  for (uint i = 0u; i < lights.directional_count; ++i) {
    DirectionalLight d = lights.directional[i];
    light += reflected(p, -d.direction, d.color);
  }
  for (uint i = 0u; i < lights.local_count; ++i) {
    vec3 to_light;
    vec3 illuminance = local_illuminance(lights.local[i], p.position, to_light);
    light += reflected(p, to_light, illuminance);
  }
  out_light = vec4(min(light, vec3(65504.0)), s.base_color.a);
}
