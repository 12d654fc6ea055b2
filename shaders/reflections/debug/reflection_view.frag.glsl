// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
#include "shaders/lighting/probe_rows_api.glsl"
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_shared.h"

// Visualizers of reflections: kShown 0 tier, 1 confidence, 2 proxies of each screen tile, 3 layers along the ray,
// 4 probes.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target's format does not encode sRGB
layout(constant_id = 1) const uint kShown = 0u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D material_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform sampler2D ssr_color;
layout(set = 0, binding = 6) uniform sampler2D color_image;
layout(set = 0, binding = 7) uniform sampler2D surface_image;
layout(set = 0, binding = 8, scalar) readonly buffer ProxyRows { ProxyRow proxy_rows[]; };
layout(set = 0, binding = 9, scalar) readonly buffer ProxyMasks { uint proxy_masks[]; };
layout(set = 0, binding = 10, scalar) readonly buffer ProbeRows { ProbeRow probe_rows[]; };
layout(set = 0, binding = 11, scalar) uniform Tiles { ProxyTileConstants tiles; };
layout(set = 0, binding = 12) uniform sampler2DArray probe_images;
layout(set = 0, binding = 13) uniform usampler2D mirror_image;

// Bit 0: screen space, bit 1: proxies, bit 2: probes; bit 3: the rows are all proxies of the world, not those of masks;
// bit 4: there are mirror surfaces.
layout(push_constant, scalar) uniform Push { uint tiers; };

layout(location = 0) out vec4 out_picture;
layout(location = 1) out vec4 out_named;  // values in rgb; a must be 1 with them, because targets are alpha-blended

#define GLOAM_CAPTURE_FACTOR(i) vec3(1.0)  // only shares of probes are shown
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/lighting/probes_api.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/proxies/proxies_api.glsl"

const float kDarkened = 0.75;  // opacity of black where there is nothing to show

void show(vec3 color, float opacity) { out_picture = vec4(kEncode != 0u ? linear_to_srgb(color) : color, opacity); }

uint tile_word(uint tile, uint word) { return (tiers & 2u) != 0u ? proxy_masks[tile * tiles.words + word] : 0u; }

uint tile_of(ivec2 texel) { return uint(texel.x) * tiles.tiles / reflection.size.x; }

// The proxies of the texel's tile.
uint listed_proxies(ivec2 texel) {
  uint count = 0u;
  for (uint word = 0u; word < tiles.words; ++word) count += bitCount(tile_word(tile_of(texel), word));
  return count;
}

// 1 if the ray of a texel meets a proxy.
uint met_by(MirrorSurface s, uint row) {
  ProxyRow proxy = proxy_rows[row];
  return proxy.room != 0u && proxy.opacity > 0.0 && meet_proxy(proxy, s.position, s.direction).met ? 1u : 0u;
}

// The proxies that a texel's ray meets.
uint met_proxies(ivec2 texel, MirrorSurface s) {
  uint count = 0u;
  if ((tiers & 10u) == 10u)
    for (uint row = 0u; row < tiles.proxies; ++row) count += met_by(s, row);
  if ((tiers & 10u) == 2u)
    for (uint word = 0u; word < tiles.words; ++word)
      for (uint bits = tile_word(tile_of(texel), word); bits != 0u; bits &= bits - 1u)
        count += met_by(s, word * 32u + uint(findLSB(bits)));
  return count;
}

// Share of the probes with a box, and of the global probe, at a pixel.
vec2 probe_shares(vec3 position, vec3 normal) {
  vec2 shares = vec2(0.0);
  for (uint i = 0u; i < tiles.probes; ++i) {
    ProbeRow probe = probe_rows[i];
    vec3 offset = position - probe.center;
    vec3 at = vec3(dot(probe.to_x, offset), dot(probe.to_y, offset), dot(probe.to_z, offset));
    float share = facing_share(probe, at, normal) * (1.0 - shares.x - shares.y);
    shares += probe.global > 0.5 ? vec2(0.0, share) : vec2(share, 0.0);
  }
  return shares;
}

// Spheres that mirror the maps of the probes, at their centres.

const float kSphereOfBox = 0.1;  // radius as a share of half the box's shortest side,
const float kMostSphere = 0.15;  // and in units; of the global probe always

float sphere_radius(ProbeRow probe) {
  if (probe.global > 0.5) return kMostSphere * reflection.unit_m;
  float steepest = max(length(probe.to_x), max(length(probe.to_y), length(probe.to_z)));
  return min(kSphereOfBox / steepest, kMostSphere * reflection.unit_m);
}

// Light of the nearest sphere before the surface of a pixel. nearest_m: distance to the surface, then to the sphere.
// False: there is none.
bool sphere_light(vec3 eye, vec3 ray, inout float nearest_m, out vec3 light) {
  uint shown = tiles.probes;
  light = vec3(0.0);
  for (uint i = 0u; i < tiles.probes; ++i) {
    vec3 to_center = probe_rows[i].center - eye;
    float along = dot(to_center, ray), radius_m = sphere_radius(probe_rows[i]);
    vec3 beside = to_center - along * ray;
    float half_chord_squared = radius_m * radius_m - dot(beside, beside);
    float front_m = along - sqrt(max(half_chord_squared, 0.0));
    bool nearer = half_chord_squared > 0.0 && front_m > 0.0 && front_m < nearest_m;
    nearest_m = nearer ? front_m : nearest_m;
    shown = nearer ? i : shown;
  }
  if (shown == tiles.probes) return false;
  ProbeRow probe = probe_rows[shown];
  vec3 normal = normalize(eye + ray * nearest_m - probe.center);
  light = probe_radiance(probe.layer, probe.emission, -1.0, reflect(ray, normal), 0.0);
  return true;
}

void show_probes(ivec2 pixel, float depth, vec3 position) {
  bool surface = depth > 0.0, has_probes = (tiers & 4u) != 0u;
  vec3 normal = surface ? unpack_normal(texelFetch(normal_image, pixel, 0).x) : vec3(0.0, 1.0, 0.0);
  vec3 light = vec3(0.0), sphere = vec3(0.0);
  float covered = 0.0;
  if (has_probes && surface)
    light = probes_radiance(tiles.probes, position, normal, reflect(-normalize(to_viewer(view, position)), normal), 0.0,
                            covered);
  // A point of the pixel's ray, for the sky, too.
  vec3 on_ray = view_ray(view, vec2(pixel)), ray = -normalize(to_viewer(view, on_ray));
  vec3 eye = view.orthographic != 0u ? on_ray - ray * view_depth(view, on_ray) : vec3(0.0);
  float nearest_m = surface ? dot(position - eye, ray) : 1e30;
  bool on_sphere = has_probes && sphere_light(eye, ray, nearest_m, sphere);
  if (on_sphere) light = sphere;
  light *= reflection.capture_scale / view.light_scale;  // cd/m²
  if (surface || on_sphere) out_named = vec4(min(light, vec3(65504.0)), 1.0);
  show(light / (light + 1.0), surface || on_sphere ? 1.0 : kDarkened);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), texel = min(pixel / int(reflection.scale), ivec2(reflection.size) - 1);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec4 material = depth > 0.0 ? texelFetch(material_image, pixel, 0) : vec4(0.0);
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  uvec2 normals = depth > 0.0 ? texelFetch(normal_image, pixel, 0).xy : uvec2(0u);
  float up = depth > 0.0 ? unpack_normal(normals.y).y : 0.0, rise = normalize(to_viewer(view, position)).y;
  bool reflects = material.w > 0.0;
  // Images of tiers hold values only in tiles with a mirror surface, and the picture shows them only at its pixels.
  bool mirror_here = (tiers & 16u) != 0u && mirror_share(up, rise, material.x, material.w) > 0.0;
  MirrorSurface s = decode_mirror_surface(mirror_here ? texelFetch(mirror_image, texel, 0).xy : uvec2(0u), texel);
  bool mirrors = mirror_here && (tiers & 3u) != 0u && s.share > 0.0;
  vec4 color = mirrors ? texelFetch(color_image, texel, 0) : vec4(0.0);
  float screen = mirrors && (tiers & 1u) != 0u ? texelFetch(ssr_color, texel, 0).a * s.share : 0.0;
  vec2 shares = reflects && (tiers & 4u) != 0u ? probe_shares(position, unpack_normal(normals.x)) : vec2(0.0);
  out_named = vec4(0.0);
  if (kShown == 0u) {
    float mirrored = min(color.a, 1.0), unmirrored = 1.0 - mirrored;
    // Screen space green, proxies orange, probes with a box blue; the rest, global probe and sky, violet.
    vec3 tiers_of = vec3(min(screen, mirrored), max(mirrored - screen, 0.0), unmirrored * shares.x);
    if (reflects) out_named = vec4(tiers_of, 1.0);
    show(tiers_of.x * vec3(0.05, 0.7, 0.1) + tiers_of.y * vec3(0.9, 0.35, 0.02) + tiers_of.z * vec3(0.02, 0.15, 0.8) +
             unmirrored * (1.0 - shares.x) * vec3(0.25, 0.05, 0.35),
         reflects ? 0.85 : kDarkened);
    if (!reflects) show(vec3(0.0), kDarkened);
  } else if (kShown == 1u) {
    out_named = vec4(screen, color.a, 0.0, 1.0);
    show(heat(screen), reflects ? 0.85 : kDarkened);
  } else if (kShown == 2u) {
    float count = float(listed_proxies(texel));
    out_named = vec4(count, 0.0, 0.0, 1.0);
    show(heat(count / 31.0), 0.7);
  } else if (kShown == 3u) {
    float count = mirrors ? float(met_proxies(texel, s)) + (screen > 0.0 ? 1.0 : 0.0) : 0.0;
    out_named = vec4(count, 0.0, 0.0, 1.0);
    show(heat(count / 5.0), mirrors ? 0.85 : kDarkened);
  } else {
    show_probes(pixel, depth, position);
  }
}
