// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_SURFACE_API_GLSL
#define GLOAM_SHADERS_RENDER_SURFACE_API_GLSL

// Surface attributes of a fragment of a mesh. Include it in fragment shaders that follow surface.vert; uses set 1.

#include "shaders/common/math.glsl"
#include "shaders/render/draw_shared.h"

// Packed into few vectors: each vector costs triangle set-up, even if only partly used.
layout(location = 0) in vec4 in_relative_u;  // camera-relative position, u of the first coordinates
layout(location = 1) in vec4 in_normal_v;    // normal, v of the first coordinates
layout(location = 2) in vec4 in_tangent;     // w: handedness, 1 or -1
layout(location = 3) in vec2 in_uv1;
layout(location = 4) in vec4 in_color;

#define in_relative (in_relative_u.xyz)
#define in_normal (in_normal_v.xyz)

layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialConstants material; };
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
layout(set = 1, binding = 2) uniform sampler2D normal_texture;
layout(set = 1, binding = 3) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;

layout(constant_id = 0) const uint kSurface = 0u;

struct Surface {
  vec4 base_color;   // linear, with alpha
  vec3 normal;       // shading normal on the visible side; unit length only from fetch_surface
  vec3 face_normal;  // normal of the triangle, same side and length as `normal`
  float metallic;
  float roughness;
  float occlusion;
  float reflectivity;  // 0…1
  vec3 emissive;       // cd/m²
  bool subsurface;
};

vec2 texture_uv(int slot) {
  vec2 uv0 = vec2(in_relative_u.w, in_normal_v.w);
  if ((kSurface & GLOAM_SURFACE_UV_TRANSFORM) == 0u) return uv0;
  vec4 row0 = material.uv_transform[2 * slot];
  vec4 row1 = material.uv_transform[2 * slot + 1];
  vec3 uv = vec3(row0.w < 0.5 ? uv0 : in_uv1, 1.0);
  return vec2(dot(row0.xyz, uv), dot(row1.xyz, uv));
}

float size_of(vec3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// Roughness of a pixel in which the normal changes: each normal sends a highlight elsewhere, so the pixel's lobe is
// that of the surface and the spread of its normals together. GGX slopes have the width alpha = roughness²; widths add
// as squares. The spread is limited, because a large one is an edge, not a curve (Tokuyoshi and Kaplanyan 2019).
// variance: 0: off.
float filtered_roughness(float roughness, vec3 normal, float variance) {
  vec3 n = normalize(normal);
  vec3 dx = dFdx(n), dy = dFdy(n);
  float spread = min(variance * (dot(dx, dx) + dot(dy, dy)), 0.18);
  float alpha2 = roughness * roughness * roughness * roughness;
  return spread > 1e-3 * max(alpha2, 1e-6) ? sqrt(sqrt(min(alpha2 + spread, 1.0))) : roughness;
}

// Fetches the surface at a fragment; discards masked fragments. Its normals have any length above 0, which is enough
// for packing. `to_viewer`: direction to the camera, any length (view_api.glsl). normal_variance: of ViewConstants.
Surface fetch_surface_unscaled(vec3 to_viewer, float normal_variance) {
  Surface s;
  s.base_color = material.base_color;
  if ((kSurface & GLOAM_SURFACE_VERTEX_COLOR) != 0u) s.base_color *= in_color;
  if ((kSurface & GLOAM_SURFACE_BASE_TEXTURE) != 0u) s.base_color *= texture(base_color_texture, texture_uv(0));

  // The visible side is the one towards the camera, regardless of winding and mirroring.
  s.face_normal = cross(dFdx(in_relative), dFdy(in_relative));
  if (dot(s.face_normal, to_viewer) < 0.0) s.face_normal = -s.face_normal;
  if (!(size_of(s.face_normal) > 1e-30)) s.face_normal = to_viewer;  // degenerate derivatives

  // Which side is seen follows from the winding alone: shading normals may lean to the other side.
  bool back =
      (kSurface & GLOAM_SURFACE_DOUBLE_SIDED) != 0u && gl_FrontFacing == ((kSurface & GLOAM_SURFACE_FLIPPED) != 0u);
  vec3 front_normal = in_normal, tangent = in_tangent.xyz;
  if ((kSurface & GLOAM_SURFACE_FLAT) != 0u) {
    front_normal = normalize(back ? -s.face_normal : s.face_normal);
    tangent = normalize(tangent - dot(tangent, front_normal) * front_normal);
  }
  s.normal = front_normal;
  if ((kSurface & GLOAM_SURFACE_NORMAL_TEXTURE) != 0u) {
    vec3 t = texture(normal_texture, texture_uv(1)).xyz * 2.0 - 1.0;
    t.xy *= material.factors.z;
    // The tangent frame has unit length at vertices and is used as interpolated, not normalised, as in the baking of
    // normal maps.
    vec3 bitangent = cross(front_normal, tangent) * in_tangent.w;
    s.normal = tangent * t.x + bitangent * t.y + front_normal * t.z;
  }
  // Double-sided materials shade their back with the reversed normal.
  if (back) s.normal = -s.normal;
  if (!(size_of(s.normal) > 1e-30)) s.normal = s.face_normal;

  s.metallic = material.factors.x;
  s.roughness = material.factors.y;
  if ((kSurface & GLOAM_SURFACE_METALLIC_ROUGHNESS_TEXTURE) != 0u) {
    vec4 mr = texture(metallic_roughness_texture, texture_uv(2));
    s.metallic *= mr.b;
    s.roughness *= mr.g;
  }
  s.occlusion = 1.0;
  if ((kSurface & GLOAM_SURFACE_OCCLUSION_TEXTURE) != 0u)
    s.occlusion = 1.0 + material.factors.w * (texture(occlusion_texture, texture_uv(3)).r - 1.0);
  s.emissive = material.emissive_cutoff.rgb;
  if ((kSurface & GLOAM_SURFACE_EMISSIVE_TEXTURE) != 0u) s.emissive *= texture(emissive_texture, texture_uv(4)).rgb;
  s.subsurface = material.extras.x > 0.5;
  float smoothness = 1.0 - s.roughness;
  s.reflectivity = material.extras.y >= 0.0 ? material.extras.y : smoothness * mix(0.5, 1.0, s.metallic);
  if (normal_variance > 0.0) s.roughness = filtered_roughness(s.roughness, s.normal, normal_variance);
  // Last, because derivatives and texture lookups above need whole quads.
  if ((kSurface & GLOAM_SURFACE_MASK) != 0u && s.base_color.a < material.emissive_cutoff.a) discard;
  return s;
}

// Like fetch_surface_unscaled, but with unit normals.
Surface fetch_surface(vec3 to_viewer, float normal_variance) {
  Surface s = fetch_surface_unscaled(to_viewer, normal_variance);
  s.normal = normalize(s.normal);
  s.face_normal = normalize(s.face_normal);
  return s;
}

#endif
