// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
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

layout(push_constant, scalar) uniform Push { uint tiers; };  // bit 0: screen space, bit 1: proxies, bit 2: probes, bit 3: mirrors

layout(location = 0) out vec4 out_picture;
layout(location = 1) out vec4 out_named;  // values in rgb; a must be 1 with them, because targets are alpha-blended

#define GLOAM_CAPTURE_FACTOR(i) vec3(1.0)  // only shares of probes are shown
#include "shaders/lighting/probes_api.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/proxies/proxies_api.glsl"

const float kDarkened = 0.75;  // opacity of black where there is nothing to show

void show(vec3 color, float opacity) { out_picture = vec4(kEncode != 0u ? linear_to_srgb(color) : color, opacity); }

uint tile_word(uint tile, uint word) { return (tiers & 2u) != 0u ? proxy_masks[tile * tiles.words + word] : 0u; }

// The proxies of the texel's tile, or those of them that its ray meets.
uint count_proxies(ivec2 texel, MirrorSurface s, bool met_only) {
  uint tile = uint(texel.x) * tiles.tiles / reflection.size.x, count = 0u;
  for (uint word = 0u; word < tiles.words; ++word)
    for (uint bits = tile_word(tile, word); bits != 0u; bits &= bits - 1u) {
      ProxyRow proxy = proxy_rows[word * 32u + uint(findLSB(bits))];
      bool met = meet_proxy(proxy, s.position, s.direction).met && proxy.opacity > 0.0;
      count += met || !met_only ? 1u : 0u;
    }
  return count;
}

// Share of the probes with a box, and of the global probe, at a pixel.
vec2 probe_shares(vec3 position) {
  vec2 shares = vec2(0.0);
  for (uint i = 0u; i < tiles.probes; ++i) {
    ProbeRow probe = probe_rows[i];
    vec3 offset = position - probe.center;
    vec3 at = vec3(dot(probe.to_x, offset), dot(probe.to_y, offset), dot(probe.to_z, offset));
    float share = probe_share(probe, at) * (1.0 - shares.x - shares.y);
    shares += probe.global > 0.5 ? vec2(0.0, share) : vec2(share, 0.0);
  }
  return shares;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), texel = min(pixel / int(reflection.scale), ivec2(reflection.size) - 1);
  float depth = texelFetch(depth_image, pixel, 0).r, reflectivity = texelFetch(material_image, pixel, 0).w;
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  bool reflects = depth > 0.0 && reflectivity > 0.0, mirrors = reflects && (tiers & 3u) != 0u;
  MirrorSurface s = decode_mirror_surface((tiers & 8u) != 0u ? texelFetch(mirror_image, texel, 0).xy : uvec2(0u), texel);
  vec4 color = mirrors ? texelFetch(color_image, texel, 0) : vec4(0.0);
  float screen = mirrors && (tiers & 1u) != 0u ? texelFetch(ssr_color, texel, 0).a * s.share : 0.0;
  vec2 shares = reflects && (tiers & 4u) != 0u ? probe_shares(position) : vec2(0.0);
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
    float count = float(count_proxies(texel, s, false));
    out_named = vec4(count, 0.0, 0.0, 1.0);
    show(heat(count / 31.0), 0.7);
  } else if (kShown == 3u) {
    float count = mirrors && s.share > 0.0 ? float(count_proxies(texel, s, true)) + (screen > 0.0 ? 1.0 : 0.0) : 0.0;
    out_named = vec4(count, 0.0, 0.0, 1.0);
    show(heat(count / 5.0), mirrors && s.share > 0.0 ? 0.85 : kDarkened);
  } else {
    vec3 direction =
        reflect(-normalize(to_viewer(view, position)), unpack_normal(texelFetch(normal_image, pixel, 0).x));
    float covered = 0.0;
    vec3 light = vec3(0.0);
    if ((tiers & 4u) != 0u && depth > 0.0) light = probes_radiance(tiles.probes, position, direction, 0.0, covered);
    if (depth > 0.0) out_named = vec4(min(light, vec3(65504.0)), 1.0);
    show(light / (light + 1.0), depth > 0.0 ? 1.0 : kDarkened);
  }
}
