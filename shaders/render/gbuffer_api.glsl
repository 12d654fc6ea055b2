// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_GBUFFER_API_GLSL
#define GLOAM_SHADERS_RENDER_GBUFFER_API_GLSL

// Layout of the geometry buffer:
//   base color  rgba8_unorm  square roots of rgb, a = subsurface 0 or 1, and between them the spread of normals
//               (in dark colours square roots are as precise as sRGB; they take one instruction). Thin surfaces have
//               128/255: subsurface, no spread (is_thin)
//   normals     rg32_uint    octahedral shading normal, octahedral face normal
//   material    rgba8_unorm  roughness, metallic, occlusion, reflectivity
//   emissive    rgba16_float cd/m² · ViewConstants::light_scale, a = square root of the extinction length in metres of
//               materials that let light through (transmission_api.glsl), 0 for others
//   depth       d32          reversed Z, 0 = sky
//   smooth surfaces  rg32_uint  smooth_surface_api.glsl; drawn by the renderer alone, only in frames that need it
//   motion      rg32f        pixels since the previous frame (motion_api.glsl); only in frames that need it
//
// A fragment shader of PassPhase::geometry writes locations 0 to 3, and location 4 if the frame has motion:
//   layout(location = 0) out vec4 out_base_color;   encode_base_color(base_color, subsurface), or with spread;
//                                                   encode_thin_color(base_color)
//   layout(location = 1) out uvec4 out_normals;     encode_normals(normal, face_normal), both towards the viewer
//   layout(location = 2) out vec4 out_material;     vec4(roughness, metallic, occlusion, reflectivity), each 0…1
//   layout(location = 3) out vec4 out_emissive;     vec4(emissive, 0.0), emissive in cd/m² · light_scale; alpha above 0
//                                                   only with subsurface
//   layout(location = 4) out vec2 out_motion;       screen_motion(…)

#include "shaders/common/math.glsl"

struct GBufferTexel {
  vec3 base_color;
  bool subsurface;
  bool thin;            // a blade of grass or the like; also subsurface
  float normal_spread;  // square of a width of slopes (normal_spread_in_pixel), 0…0.18
  vec3 normal;
  vec3 face_normal;
  float roughness;
  float metallic;
  float occlusion;
  float reflectivity;
};

// The spread is stored in alpha by its distance from the flag that alpha holds, in 126 steps of 10 %.
const float kGreatestSpread = 0.18;
const float kSpreadSteps = 126.0;
const float kSpreadOctaves = 17.5;

// base_color: linear. normal_spread: 0…kGreatestSpread.
vec4 encode_base_color(vec3 base_color, bool subsurface, float normal_spread) {
  float step_of = kSpreadSteps + log2(max(normal_spread, 1e-9) / kGreatestSpread) * (kSpreadSteps / kSpreadOctaves);
  float code = max(floor(step_of + 0.5), 0.0) / 255.0;
  return vec4(sqrt(max(base_color, vec3(0.0))), subsurface ? 1.0 - code : code);
}

vec4 encode_base_color(vec3 base_color, bool subsurface) { return encode_base_color(base_color, subsurface, 0.0); }

// Blades of grass and the like: about a pixel wide, subsurface, many to a tile. Shadows on them may have a filter of
// their own (kThinFilter in shadows_api.glsl). The code is one that no spread has.
const float kThinCode = 128.0;
vec4 encode_thin_color(vec3 base_color) { return vec4(sqrt(max(base_color, vec3(0.0))), kThinCode / 255.0); }
bool is_thin(float alpha) { return abs(255.0 * alpha - kThinCode) < 0.5; }

float decode_normal_spread(float alpha) {
  float code = 255.0 * min(alpha, 1.0 - alpha);
  return code < 0.5 || code > kSpreadSteps + 0.5
             ? 0.0
             : kGreatestSpread * exp2((code - kSpreadSteps) * (kSpreadOctaves / kSpreadSteps));
}

// Normals of any length above 0, in world axes.
uvec4 encode_normals(vec3 normal, vec3 face_normal) {
  return uvec4(pack_normal(normal), pack_normal(face_normal), 0u, 0u);
}

GBufferTexel decode_gbuffer(vec4 base_color, uvec2 normals, vec4 material) {
  GBufferTexel g;
  g.base_color = base_color.rgb * base_color.rgb;
  g.subsurface = base_color.a > 0.5;
  g.thin = is_thin(base_color.a);
  g.normal_spread = decode_normal_spread(base_color.a);
  g.normal = unpack_normal(normals.x);
  g.face_normal = unpack_normal(normals.y);
  g.roughness = material.x;
  g.metallic = material.y;
  g.occlusion = material.z;
  g.reflectivity = material.w;
  return g;
}

#endif
