// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_GBUFFER_API_GLSL
#define GLOAM_SHADERS_RENDER_GBUFFER_API_GLSL

// Layout of the geometry buffer:
//   base color  rgba8_unorm  square roots of rgb, a = subsurface 0 or 1
//               (in dark colours square roots are as precise as sRGB; they take one instruction)
//   normals     rg32_uint    octahedral shading normal, octahedral face normal
//   material    rgba8_unorm  roughness, metallic, occlusion, reflectivity
//   emissive    rgba16_float cd/m²
//   depth       d32          reversed Z, 0 = sky

#include "shaders/common/math.glsl"

struct GBufferTexel {
  vec3 base_color;
  bool subsurface;
  vec3 normal;
  vec3 face_normal;
  float roughness;
  float metallic;
  float occlusion;
  float reflectivity;
};

GBufferTexel decode_gbuffer(vec4 base_color, uvec2 normals, vec4 material) {
  GBufferTexel g;
  g.base_color = base_color.rgb * base_color.rgb;
  g.subsurface = base_color.a > 0.5;
  g.normal = unpack_normal(normals.x);
  g.face_normal = unpack_normal(normals.y);
  g.roughness = material.x;
  g.metallic = material.y;
  g.occlusion = material.z;
  g.reflectivity = material.w;
  return g;
}

#endif
