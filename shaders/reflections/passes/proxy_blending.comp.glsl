// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Image-based reflections (reflections tier 2), merged with those of screen space: the nearest layers along the
// mirrored ray, sorted by distance, blended front to back. Writes what the later passes need of a reflection.

layout(constant_id = 0) const uint kScreenSpace = 1u;  // 0: without tier 1
layout(constant_id = 1) const uint kProxies = 1u;      // 0: without tier 2
layout(constant_id = 2) const uint kLayers = 4u;       // entries of the sorted array, 1…4
layout(constant_id = 3) const uint kSphereTest = 1u;
layout(constant_id = 4) const uint kNaive = 0u;           // 1: every proxy of the world for every pixel, without tiles
layout(constant_id = 5) const uint kPixelRoughness = 1u;  // 0: one spread for all surfaces, as in the paper
layout(constant_id = 6) const uint kSort = 1u;            // 0: layers stay in the order in which they are inserted
layout(constant_id = 7) const uint kPixelNormals = 0u;    // 1: rays follow the normals of pixels
layout(constant_id = 8) const uint kFactors = 1u;         // 0: all lamps are as captured, no row has factors

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D mirror_image;
layout(set = 0, binding = 5) uniform sampler2D ssr_color;
layout(set = 0, binding = 6) uniform sampler2D ssr_distance;
layout(set = 0, binding = 7, scalar) readonly buffer ProxyRows { ProxyRow proxy_rows[]; };
layout(set = 0, binding = 8, scalar) readonly buffer ProxyMasks { uint proxy_masks[]; };
layout(set = 0, binding = 9) uniform sampler2DArray proxy_images;
layout(set = 0, binding = 10, scalar) readonly buffer CaptureFactors { vec4 capture_factors[]; };
layout(set = 0, binding = 11) uniform usampler2D normal_image;
layout(set = 0, binding = 12, scalar) uniform Tiles { ProxyTileConstants tiles; };
layout(set = 0, binding = 13, rgba16f) uniform writeonly image2D color_image;  // premultiplied radiance, confidence
layout(set = 0, binding = 14, rgba8) uniform writeonly image2D surface_image;  // spread, roughness, packed distance

#define GLOAM_MIRROR_TILES 3
#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/passes/pixel_normal.glsl"
#include "shaders/lighting/changed_light_api.glsl"
#include "shaders/reflections/proxies/proxies_api.glsl"
#include "shaders/reflections/spread_api.glsl"

const float kFar = 1e9;
const float kBehindScreen = 0.3;  // units; a proxy this little in front of a hit of screen space stands for its surface

// A layer along the ray. `order_m` sorts; kFar: empty.
struct Layer {
  float order_m;
  float distance_m;
  vec4 light;  // premultiplied radiance and alpha
};
Layer layers[4];

// Inserts a layer; the farthest one, or without sorting the last one, is dropped when the array is full.
void insert(Layer layer) {
  for (uint i = 0u; i < kLayers; ++i) {
    bool nearer = layer.order_m < layers[i].order_m;
    if (kSort == 0u) nearer = layers[i].order_m == kFar;
    Layer moved = layers[i];
    if (nearer) layers[i] = layer;
    if (nearer) layer = moved;
  }
}

// The proxy's image where the ray meets it. The mip follows the distance of the mirrored picture.
vec4 proxy_light(ProxyRow proxy, ProxyHit hit, MirrorSurface s) {
  float away = view.orthographic != 0u ? 1.0 : length(s.position) + hit.distance_m;
  float lod = log2(max(length(view.ray_dx.xyz) * float(reflection.scale) * away / proxy.texel_m, 1.0));
  vec4 light = textureLod(proxy_images, vec3(hit.uv, proxy.layer), lod);
  if (kFactors != 0u && proxy.factor >= 0.0) {
    vec3 unscaled = vec3(0.0);
    if (proxy.emission >= 0.0) unscaled = textureLod(proxy_images, vec3(hit.uv, proxy.emission), lod).rgb;
    light.rgb = followed_light(light.rgb, unscaled, captured_factor(proxy.factor, GLOAM_PROXY_CELLS, hit.uv));
  }
  return vec4(light.rgb * reflection.capture_scale, light.a * proxy.opacity);
}

void try_proxy(uint index, MirrorSurface s) {
  ProxyRow proxy = proxy_rows[index];
  if (kNaive != 0u && proxy.room == 0u) return;
  if (kSphereTest != 0u && !meets_sphere(proxy, s.position, s.direction)) return;
  ProxyHit hit = meet_proxy(proxy, s.position, s.direction);
  if (hit.met && proxy.opacity > 0.0) insert(Layer(hit.distance_m, hit.distance_m, proxy_light(proxy, hit, s)));
}

void add_proxies(MirrorSurface s, int column) {
  if (kNaive != 0u) {
    for (uint i = 0u; i < tiles.proxies; ++i) try_proxy(i, s);
    return;
  }
  uint tile = uint(column) * tiles.tiles / reflection.size.x;
  if (tiles.words == 0u) return;
  // Tested at the end: a processor goes once more through a loop that tests first.
  uint word = 0u;
  do {
    uint bits = proxy_masks[tile * tiles.words + word];
    if (bits != 0u) do {
        try_proxy(word * 32u + uint(findLSB(bits)), s);
        bits &= bits - 1u;
      } while (bits != 0u);
  } while (++word < tiles.words);
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  MirrorSurface s = decode_mirror_surface(texelFetch(mirror_image, texel, 0).xy, texel);
  vec4 color = vec4(0.0), surface = vec4(0.0);
  if (s.share > 0.0) {
    if (kPixelNormals != 0u) follow_normal(s);
    for (uint i = 0u; i < 4u; ++i) layers[i] = Layer(kFar, 0.0, vec4(0.0));
    if (kScreenSpace != 0u) {
      vec4 ssr = texelFetch(ssr_color, texel, 0);
      float distance_m = reflection.unit_m * unpack_hit_distance(texelFetch(ssr_distance, texel, 0).xy);
      if (ssr.a > 0.0)
        insert(Layer(distance_m - kBehindScreen * reflection.unit_m, distance_m, vec4(ssr.rgb * ssr.a, ssr.a)));
    }
    if (kProxies != 0u) add_proxies(s, texel.x);
    float distance_m = 0.0;
    for (uint i = 0u; i < kLayers; ++i) {
      float part = 1.0 - color.a;
      color += part * layers[i].light;
      distance_m += part * layers[i].light.a * layers[i].distance_m;
    }
    // The remaining share is seen in a probe, far away. A texel that mirrors nothing else has no width of its own: the
    // blurs that reach it give theirs.
    bool empty = color.a <= 1e-3;
    distance_m = empty ? kMostHitCentimetres * 0.01 * reflection.unit_m : distance_m / color.a;
    float spread = kPixelRoughness != 0u ? mirrored_share(s, distance_m) : screen_distance(s, distance_m);
    surface =
        vec4(empty ? 0.0 : spread, max(s.roughness, 1.0 / 255.0), pack_hit_distance(distance_m / reflection.unit_m));
    color *= s.share;
  }
  imageStore(color_image, texel, color);
  imageStore(surface_image, texel, surface);
}
