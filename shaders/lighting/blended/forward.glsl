// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_BLENDED_FORWARD_GLSL
#define GLOAM_SHADERS_LIGHTING_BLENDED_FORWARD_GLSL

#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"

// Lights blended surfaces while they are drawn. Shared by forward.frag, forward_tiled.frag and their variants with
// shadows or cookies, which define macros of forward_lights_api.glsl. Early lists cannot be used: they hold only lights
// at opaque depths.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

#define GLOAM_FORWARD_BINDING 1
#include "shaders/lighting/forward_lights_api.glsl"
#define GLOAM_SURROUNDINGS_BINDING 24
#include "shaders/lighting/surroundings_api.glsl"
#define GLOAM_INDIRECT_BINDING 28
#include "shaders/lighting/indirect_api.glsl"

layout(location = 0) out vec4 out_light;

vec3 surrounding_light(ShadingPoint p, Surface s) {
  SurroundingLight around = surrounding_light(p.position, p.normal);
  vec3 mirrored = mirrored_surroundings(p, s.roughness, around);
  vec3 specular = kReflects == 0u ? specular_share(p, s.roughness) * mirrored
                                  : specular_surroundings(p, s.roughness, s.reflectivity, mirrored);
  return s.occlusion * (diffuse_surroundings(p, around) + specular);
}

void main() {
  vec3 to_eye = normalize(to_viewer(view, in_relative));
  Surface s = fetch_surface(to_eye, view.normal_variance, view.light_scale, view.mip_bias);
  ShadingPoint p = shading_point(in_relative, to_eye, s.normal, s.base_color.rgb, s.metallic, s.roughness);
  p.normal_spread = s.normal_spread;
  set_receiver(in_relative, s.face_normal, s.subsurface);
  if (kTransmission != 0u) extinction_m = decode_extinction(s.extinction_root);
  vec3 light = s.emissive + surrounding_light(p, s);
  add_forward_lights(light, p, uvec2(gl_FragCoord.xy));
  out_light = vec4(min(light, vec3(65504.0)), s.base_color.a);
  if ((kSurface & GLOAM_SURFACE_CLIPPED) != 0u && is_clipped(view, in_relative)) discard;
}

#endif
