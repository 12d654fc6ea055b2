// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_FORWARD_GLSL
#define GLOAM_SHADERS_LIGHTING_FORWARD_GLSL

#include "shaders/lighting/environment.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"

// Lights blended surfaces while they are drawn. Shared by forward.frag, forward_tiled.frag and their variants with
// shadows or cookies, which define local_lights.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Environment { EnvironmentConstants environment; };

layout(location = 0) out vec4 out_light;

#include "shaders/lighting/arriving_light.glsl"

vec3 add_local(ShadingPoint p, uint index, LocalLight light) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(light, p.position, to_light);
  illuminance = arriving_local(illuminance, index, light.position, p.normal, to_light);
  return reflected(p, to_light, illuminance);
}

// Radiance from local lights at the surface, summed in ascending order (see deferred.glsl).
vec3 local_lights(ShadingPoint p);

void main() {
  vec3 to_eye = normalize(to_viewer(view, in_relative));
  Surface s = fetch_surface(to_eye);
  ShadingPoint p = shading_point(in_relative, to_eye, s.normal, s.base_color.rgb, s.metallic, s.roughness);
  set_receiver(in_relative, s.face_normal, s.subsurface);
  vec3 light = s.emissive + ambient(environment, p, s.roughness, s.occlusion);
  for (uint i = 0u; i < lights.directional_count; ++i) {
    DirectionalLight d = lights.directional[i];
    light += reflected(p, -d.direction, arriving_directional(d.color, i, d.direction, p.normal));
  }
  light += local_lights(p);
  out_light = vec4(min(light, vec3(65504.0)), s.base_color.a);
  if ((kSurface & GLOAM_SURFACE_CLIPPED) != 0u && is_clipped(view, in_relative)) discard;
}

#endif
