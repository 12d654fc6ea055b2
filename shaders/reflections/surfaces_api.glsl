// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_SURFACES_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_SURFACES_API_GLSL

#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// The surfaces that screen space and proxies serve: reflective, smooth and nearly horizontal. Include this after the
// uniforms `view` and `reflection` and the images normal_image, material_image and depth_image.

const float kFullTilt = 0.966;  // cosine of 15°: up to here a surface counts as horizontal
const float kMostTilt = 0.866;  // cosine of 30°: from here on it has the cube tiers alone
const float kSmooth = 0.25;     // roughness up to which mirrored images are blurred
const float kTooRough = 0.4;    // roughness from which on the prefiltered probes serve alone

// Share of the reflection that comes from screen space and proxies, 0…1; the probes have the rest.
float mirror_share(float up, float roughness, float reflectivity) {
  float tilt = smoothstep(kMostTilt, kFullTilt, up);
  return reflectivity > 0.0 ? tilt * (1.0 - smoothstep(kSmooth, kTooRough, roughness)) : 0.0;
}

// Offsets of the pixels of a 2×2 block, in the order of textureGather's components w, z, x, y.
ivec2 block_offset(uint i) { return ivec2(i & 1u, i >> 1); }

// The pixel of the block under a texel of the reflection images that reflects; its first one if none does.
ivec2 surface_pixel(ivec2 texel) {
  if (reflection.scale == 1u) return texel;
  ivec2 last = ivec2(view.size) - 1, base = texel * 2;
  vec2 at = (vec2(base) + 1.0) * view.inverse_size;
  vec4 reflectivity = textureGather(material_image, at, 3).wzxy, roughness = textureGather(material_image, at, 0).wzxy;
  uint chosen = reflection.first_candidate;
  for (uint k = 0u; k < 4u; ++k) {
    uint i = (reflection.first_candidate + 3u - k) & 3u;
    if (reflectivity[i] > 0.0 && roughness[i] < kTooRough) chosen = i;
  }
  return min(base + block_offset(chosen), last);
}

// The surface under a texel, from the geometry buffer.
MirrorSurface mirror_surface(ivec2 texel) {
  MirrorSurface s;
  s.pixel = surface_pixel(texel);
  vec4 material = texelFetch(material_image, s.pixel, 0);
  vec3 face_normal = unpack_normal(texelFetch(normal_image, s.pixel, 0).y);
  s.depth = texelFetch(depth_image, s.pixel, 0).r;
  s.roughness = material.x;
  place_mirror_surface(s);
  // Rays that do not rise are seen from below: the underside of a surface reflects nothing here.
  s.share = s.depth > 0.0 && s.direction.y > 1e-4 ? mirror_share(face_normal.y, material.x, material.w) : 0.0;
  return s;
}

#endif
