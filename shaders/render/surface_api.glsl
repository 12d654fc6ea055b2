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
  float reflectivity;   // 0…1
  float normal_spread;  // normal_spread_in_pixel
  vec3 emissive;        // cd/m² · light_scale
  bool subsurface;
  float extinction_root;  // square root of the extinction length in metres; 0: no light passes
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

// Square of the width of the slopes of the normals that a pixel shows, as the square of a Gaussian's width where it has
// fallen to 1/e. It follows Tokuyoshi and Kaplanyan 2019 with two changes. First, it is the solid angle of the normals,
// and not the sum of the squares of their changes along both axes. The two agree on a sphere. A thin pole has normals
// along an arc, and a width in all directions would show it lights that none of its normals reflects. Second, their
// width is twice that of a pixel, so that highlights which are narrower than a pixel are as bright wherever they fall.
// Wide highlights get the variance of a pixel's square, a share kPixelShare of it. The spread is limited, because a
// large one is an edge, not a curve, and 0 where it changes the highlights of the roughness little. variance: 0: off.
const float kPixelShare = 0.26;
float normal_spread_in_pixel(float roughness, vec3 normal, float variance) {
  vec3 n = normalize(normal);
  float spread = min(2.0 * variance * length(cross(dFdx(n), dFdy(n))), 0.18);
  float alpha = max(roughness * roughness, 1e-3);
  float own = 2.0 * alpha * alpha;
  spread *= (spread + kPixelShare * own) / (spread + own);
  return spread > 0.02 * own ? spread : 0.0;
}

// Fetches the surface at a fragment; discards masked fragments. Its normals have any length above 0, which is enough
// for packing. `to_viewer`: direction to the camera, any length (view_api.glsl). The three numbers are of
// ViewConstants.
Surface fetch_surface_unscaled(vec3 to_viewer, float normal_variance, float light_scale, float mip_bias) {
  Surface s;
  s.base_color = material.base_color;
  if ((kSurface & GLOAM_SURFACE_VERTEX_COLOR) != 0u) s.base_color *= in_color;
  if ((kSurface & GLOAM_SURFACE_BASE_TEXTURE) != 0u)
    s.base_color *= texture(base_color_texture, texture_uv(0), mip_bias);

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
    vec3 t = texture(normal_texture, texture_uv(1), mip_bias).xyz * 2.0 - 1.0;
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
    vec4 mr = texture(metallic_roughness_texture, texture_uv(2), mip_bias);
    s.metallic *= mr.b;
    s.roughness *= mr.g;
  }
  s.occlusion = 1.0;
  if ((kSurface & GLOAM_SURFACE_OCCLUSION_TEXTURE) != 0u)
    s.occlusion = 1.0 + material.factors.w * (texture(occlusion_texture, texture_uv(3), mip_bias).r - 1.0);
  s.emissive = material.emissive_cutoff.rgb * light_scale;
  if ((kSurface & GLOAM_SURFACE_EMISSIVE_TEXTURE) != 0u)
    s.emissive *= texture(emissive_texture, texture_uv(4), mip_bias).rgb;
  s.subsurface = material.extras.x > 0.5;
  s.extinction_root = material.extras.z;
  float smoothness = 1.0 - s.roughness;
  s.reflectivity = material.extras.y >= 0.0 ? material.extras.y : smoothness * mix(0.5, 1.0, s.metallic);
  s.normal_spread = normal_variance > 0.0 ? normal_spread_in_pixel(s.roughness, s.normal, normal_variance) : 0.0;
  // Last, because derivatives and texture lookups above need whole quads.
  if ((kSurface & GLOAM_SURFACE_MASK) != 0u && s.base_color.a < material.emissive_cutoff.a) discard;
  return s;
}

// Like fetch_surface_unscaled, but with unit normals.
Surface fetch_surface(vec3 to_viewer, float normal_variance, float light_scale, float mip_bias) {
  Surface s = fetch_surface_unscaled(to_viewer, normal_variance, light_scale, mip_bias);
  s.normal = normalize(s.normal);
  s.face_normal = normalize(s.face_normal);
  return s;
}

#endif
