// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOWS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOWS_API_GLSL

#include "shaders/render/transmission_api.glsl"
#include "shaders/shadows/shadows_shared.h"

// Evaluates how much of a light a receiver sees. Before including this, define GLOAM_SHADOWS_BINDING, the first of six
// bindings: block, rows, atlas, pyramid, cookies and traced of ShadowsOutputs (read_shadows). The
// specialisation constants are ShadowsOutputs::constants. Define GLOAM_SHADOWS_STANDARD to compile the standard filter
// only: half of the code, for pipelines that must be ready soon. Shaders that are not fragment shaders define
// GLOAM_SHADOWS_PIXEL, the ivec2 at which traced visibility is read. Shaders that judge surfaces of the geometry buffer
// define GLOAM_SMOOTH_SURFACE_BINDING, the binding of GeometryOutputs::smooth_surfaces (read_geometry), and use
// pixel_receiver().

#ifndef GLOAM_SHADOWS_PIXEL
#define GLOAM_SHADOWS_PIXEL ivec2(gl_FragCoord.xy)
#endif

layout(set = 0, binding = GLOAM_SHADOWS_BINDING, scalar) uniform ShadowBlockBinding { ShadowBlock shadow_block; };
layout(set = 0, binding = GLOAM_SHADOWS_BINDING + 1) uniform sampler2D shadow_rows;
layout(set = 0, binding = GLOAM_SHADOWS_BINDING + 2) uniform sampler2D shadow_atlas;
layout(set = 0, binding = GLOAM_SHADOWS_BINDING + 3) uniform sampler2D shadow_pyramid;
layout(set = 0, binding = GLOAM_SHADOWS_BINDING + 4) uniform sampler2DArray shadow_cookies;
layout(set = 0, binding = GLOAM_SHADOWS_BINDING + 5) uniform sampler2DArray shadow_traced;

#ifdef GLOAM_SHADOWS_STANDARD
const uint kFilter = 3u;
const int kKernel = 8;
#else
// 0 hard, 1 pcf, 2 pcss, 3 chs, 4 traced visibility (references), 5 no shadows, only cookies
layout(constant_id = 8) const uint kFilter = 3u;
// texels of the kernel's side: 4, 8, 12, 16
layout(constant_id = 9) const int kKernel = 8;
#endif
layout(constant_id = 10) const uint kMips = 1u;           // 0 off, 1 on
layout(constant_id = 11) const uint kReceiverPlane = 1u;  // 0, 1
layout(constant_id = 12) const uint kBias = 1u;           // 0 hardware (already in the map), 1 oriented
layout(constant_id = 13) const uint kKernelShape = 0u;    // 0 disc, 1 square
layout(constant_id = 14) const uint kLevels = 255u;       // 255 or 15 steps of visibility; 0: not quantised
layout(constant_id = 15) const uint kFullPenumbra = 0u;   // 1: no early-outs, to measure the filter alone
// 1: the atlas holds coverage mips, whose depths hold counts in their 6 lowest bits (GLOAM_SHADOW_MIPS_COVERAGE)
layout(constant_id = 17) const uint kCoverage = 0u;
// near_blockers.glsl: 0 off, 1 for wide blockers, 2 always where it may matter
layout(constant_id = 21) const uint kNear = 1u;
layout(constant_id = 30) const int kNearDirections = 16;  // directions from the receiver's that it looks along
// 1: receivers under pixels are judged at their smooth surface (pixel_receiver()); 0: GeometryOutputs::smooth_surfaces
// is not read
layout(constant_id = 22) const uint kTerminator = 0u;
// Bias of receivers with a subsurface material, in biases of others.
layout(constant_id = 24) const uint kSubsurfaceBias = 4u;
// Filter of thin surfaces, e.g. blades of grass, with kFilter 3: 0 as others, 1 thin_visibility()
layout(constant_id = 29) const uint kThinFilter = 0u;
// 1: lights that can hardly be seen are asked about at a few pixels of a tile (final_lists/dim_lights.glsl)
layout(constant_id = 36) const uint kDimLights = 0u;
// A pipeline may be restricted to some kinds of lights. Software devices would otherwise execute the code of all kinds
// for every light. kKinds restricts the kinds when the pipeline is created. Shaders for fixed kinds
// define GLOAM_SHADOWS_KINDS, which shortens their code as well. Shaders that define GLOAM_SHADOWS_IN_FACE promise that
// no kernel leaves its receiver's cube face.
#ifdef GLOAM_SHADOWS_KINDS
const uint kKinds = GLOAM_SHADOWS_KINDS;
#else
#define GLOAM_SHADOWS_KINDS 7
layout(constant_id = 16) const uint kKinds = GLOAM_SHADOWS_ALL_KINDS;  // GLOAM_SHADOWS_SPOTS | …
#endif
#if (GLOAM_SHADOWS_KINDS & 2) != 0 && !defined(GLOAM_SHADOWS_IN_FACE)
#define GLOAM_SHADOWS_CROSSING
#endif

struct ShadowReceiver {
  vec3 position;     // camera-relative
  vec3 face_normal;  // unit, on the visible side
  bool subsurface;
  bool smooth_surface;  // moved to its smooth surface (pixel_receiver)
  bool thin;            // is_thin() of the geometry buffer; set after pixel_receiver(), where kThinFilter matters
};

// A receiver that is judged where it is.
ShadowReceiver drawn_receiver(vec3 position, vec3 face_normal, bool subsurface) {
  return ShadowReceiver(position, face_normal, subsurface, false, false);
}

// Sine of the angle between light ray and surface below which the receiver plane gets no steeper. The smooth surface of
// a mesh curves away below a plane of this slope; a steeper one would hide near blockers in the search's coarse mips.
const float kSmoothSine = 0.02;
float least_sine(ShadowReceiver r) { return kTerminator != 0u && r.smooth_surface ? kSmoothSine : 1e-5; }

#ifdef GLOAM_SMOOTH_SURFACE_BINDING
#include "shaders/render/smooth_surface_api.glsl"

layout(set = 0, binding = GLOAM_SMOOTH_SURFACE_BINDING) uniform usampler2D smooth_surface_image;

SmoothSurface fetch_smooth_surface(ivec2 pixel) {
  return decode_smooth_surface(texelFetch(smooth_surface_image, pixel, 0).xy);
}

// Moves the receiver to the smooth surface. Nothing that the smooth surface covers is above its plane, so no facet of
// the mesh blocks where the smooth surface faces the light. Subsurface materials stay: they are lit from behind too,
// and from there a point farther out would be deeper in shadow.
ShadowReceiver on_smooth_surface(ShadowReceiver r, SmoothSurface s) {
  bool moved = s.exists && !r.subsurface;
  return ShadowReceiver(moved ? r.position + s.offset : r.position, moved ? s.normal : r.face_normal, r.subsurface,
                        moved, r.thin);
}

// The receiver for the surface of the geometry buffer under a pixel, which has this position and face normal.
ShadowReceiver pixel_receiver(vec3 position, vec3 face_normal, bool subsurface, ivec2 pixel) {
  ShadowReceiver r = drawn_receiver(position, face_normal, subsurface);
  if (kTerminator != 0u) r = on_smooth_surface(r, fetch_smooth_surface(pixel));
  return r;
}
#endif

// Size of a texel in texture coordinates of the atlas image, which is 1.5 times as wide as high.
vec2 shadow_texel_size() { return vec2(1.0 / 1.5, 1.0) / shadow_block.atlas_size; }

#include "shaders/shadows/filter/cookies.glsl"
#ifdef GLOAM_SHADOWS_STANDARD
#include "shaders/shadows/filter/contact_hardening.glsl"
#else
#include "shaders/shadows/filter/fixed_filters.glsl"
#endif
#include "shaders/shadows/filter/thin_surfaces.glsl"
#include "shaders/shadows/filter/transmission.glsl"

// The visibility as a slot stores it.
float quantised_visibility(float visibility) {
  float v = clamp(visibility, 0.0, 1.0);
  if (kLevels != 0u) {
    float levels = float(kLevels);
    v = v > 0.9999 ? 1.0 : v < 0.0001 ? 0.0 : floor(v * levels + 0.5) / levels;
  }
  return v;
}

float traced_visibility(float layer) {
  return layer < 0.0 ? 1.0 : texelFetch(shadow_traced, ivec3(GLOAM_SHADOWS_PIXEL, int(layer)), 0).x;
}

float unquantised_visibility(ShadowPoint p) {
#ifdef GLOAM_SHADOWS_STANDARD
  float visibility = chs_or_thin_visibility(p);
#else
  float visibility = kFilter == 0u   ? hard_visibility(p)
                     : kFilter == 1u ? pcf_visibility(p)
                     : kFilter == 2u ? pcss_visibility(p)
                                     : chs_or_thin_visibility(p);
#endif
  return visibility;
}

float shadow_visibility(ShadowPoint p) { return quantised_visibility(unquantised_visibility(p) * p.horizon); }

// The share of a light that arrives at a receiver: its visibility, or, for light from behind, the transmittance of what
// it has crossed. extinction_m: extinction_behind().
float shadow_share(ShadowPoint p, float extinction_m) {
  if (kTransmission == 0u) return shadow_visibility(p);
  bool behind = extinction_m > 0.0, live = p.live;
  p.live = live && !behind;
  float share = shadow_visibility(p);
  p.live = live;
  if (behind) do {
      share = quantised_visibility(transmittance(p, extinction_m));
    } while (never(p));
  return share;
}

// Whether some receivers' visibility is certain before the filter runs, by the nearest and farthest depths around them.
const bool kCertainBeforeFilter = (kFilter == 2u || kFilter == 3u) && kFullPenumbra == 0u;

// local_visibility() where that is certain, 0 or 1; otherwise −1. For filters with kCertainBeforeFilter only, and for
// light that does not come through the surface.
float certain_local_visibility(uint light, vec3 light_position, ShadowReceiver r) {
  ShadowPoint p = local_shadow_point(light, light_position, r);
  float share = 1.0;
  if (p.live) do {
      SearchRegion region = find_region(p);
      share = region.nearest > p.threshold ? -1.0 : p.horizon < 1.0 ? -1.0 : 1.0;
      if (kFilter == 3u) share = surely_unlit(p, region) ? 0.0 : share;
    } while (never(p));
  return p.horizon > 0.0 ? share : 0.0;
}

// Quantised share 0 … 1 of a local light of the view; 1 for one that casts no shadows.
float local_visibility(uint light, vec3 light_position, ShadowReceiver r, float extinction_m) {
  if (kFilter == 5u) return 1.0;
  if (kFilter == 4u) return quantised_visibility(traced_visibility(texelFetch(shadow_rows, ivec2(6, light), 0).z));
  return shadow_share(local_shadow_point(light, light_position, r), extinction_m);
}

// The same for a directional light. light_direction: unit vector in which the light shines.
float directional_visibility(uint light, vec3 light_direction, ShadowReceiver r, float extinction_m) {
  if (kFilter == 5u) return 1.0;
  if (kFilter == 4u) return quantised_visibility(traced_visibility(fetch_sun(light).z));
  return shadow_share(directional_shadow_point(light, light_direction, r), extinction_m);
}

// For a light of either kind. light_vector: position of a local light, or the direction in which a directional light
// shines. Software devices execute both branches of a condition, so shaders that do not know the kind of light call
// this instead of branching.
ShadowPoint light_shadow_point(bool directional, uint light, vec3 light_vector, ShadowReceiver r) {
  uint local = directional ? 0u : light, distant = directional ? light : 0u;
  if (kKinds == GLOAM_SHADOWS_SUNS) return directional_shadow_point(distant, light_vector, r);
  ShadowPoint p = local_shadow_point(local, light_vector, r);
  if ((kKinds & GLOAM_SHADOWS_SUNS) != 0u) {
    ShadowPoint other = directional_shadow_point(distant, light_vector, r);
    if (directional) p = other;
  }
  return p;
}

float light_visibility(bool directional, uint light, vec3 light_vector, ShadowReceiver r, float extinction_m) {
  if (kFilter == 5u) return 1.0;
  uint local = directional ? 0u : light, distant = directional ? light : 0u;
  if (kFilter == 4u) {
    float layer = directional ? fetch_sun(distant).z : texelFetch(shadow_rows, ivec2(6, local), 0).z;
    return quantised_visibility(traced_visibility(layer));
  }
  return shadow_share(light_shadow_point(directional, light, light_vector, r), extinction_m);
}

#endif
