// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_shared.h"

// Adds the specular ambient term to surfaces that reflect strongly, in the listed tiles, and keeps it. Finds those
// among them that mirrored images serve: there it keeps what they take the place of, and adds nothing; the composite
// does.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D base_color_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D material_image;
layout(set = 0, binding = 5) uniform sampler2D depth_image;
layout(set = 0, binding = 6, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 7, rgba16f) uniform image2D lit_image;
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D ambient_image;  // see StrongAmbient

layout(set = 0, binding = 11, rg32ui) uniform writeonly uimage2D mirror_image;
// Of each tile: the greatest roughness of a mirror surface, 1…255, or 0; GLOAM_TILE_… bits.
layout(set = 0, binding = 13, scalar) buffer Roughness { uint tile_roughness[]; };
layout(set = 0, binding = 14, scalar) buffer Flags { uint tile_flags[]; };

layout(constant_id = 0) const uint kMirrors = 1u;  // 0: there are no mirrored images

#define GLOAM_MIRROR_TILES 9
#include "shaders/reflections/mirror_surface_api.glsl"
#define GLOAM_SURROUNDINGS_BINDING 24
#include "shaders/lighting/surroundings_api.glsl"

const uint kMirror = GLOAM_TILE_MIRROR, kBumpyMirror = GLOAM_TILE_MIRROR | GLOAM_TILE_BUMPY;

// Flags of a pixel that reflects strongly. `s`: its surface, if it is the first that mirrored images serve.
uint add_ambient(ivec2 pixel, float depth, GBufferTexel g, inout MirrorSurface s) {
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  vec3 to_eye = normalize(to_viewer(view, position));
  ShadingPoint p = shading_point(position, to_eye, g.normal, g.base_color, g.metallic, g.roughness);
  float mirrors = kMirrors != 0u ? mirror_share(g.face_normal.y, to_eye.y, g.roughness, g.reflectivity) : 0.0;
  vec3 share = specular_share(p, g.roughness) * g.occlusion, around = mirrored_radiance(environment, p, g.roughness);
  vec3 mirrored = share * g.reflectivity * far_radiance(p, around, g.roughness);
  vec3 ambient = mirrors > 0.0 ? mirrored : mirrored + share * around * (1.0 - g.reflectivity);
  imageStore(ambient_image, pixel, vec4(min(ambient, vec3(65504.0)), mirrors));
  if (mirrors == 0.0) {
    vec4 lit = imageLoad(lit_image, pixel);
    imageStore(lit_image, pixel, vec4(min(lit.rgb + ambient, vec3(65504.0)), lit.a));
  }
  if (mirrors > 0.0 && s.share == 0.0) {
    s.pixel = pixel;
    s.depth = depth;
    s.share = mirrors;
    s.roughness = g.roughness;
  }
  return mirrors > 0.0 ? (g.normal.y < GLOAM_FLAT_MIRROR ? kBumpyMirror : kMirror) : 0u;
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  MirrorSurface s;
  s.pixel = texel * int(reflection.scale);
  s.depth = 0.0;
  s.share = 0.0;
  s.roughness = 0.0;
  uint flags = 0u, count = reflection.scale * reflection.scale, k = 0u;
  do {
    uint i = (reflection.first_candidate + k) & (count - 1u);
    ivec2 pixel = texel * int(reflection.scale) + ivec2(i & 1u, i >> 1), at = min(pixel, ivec2(view.size) - 1);
    float depth = texelFetch(depth_image, at, 0).r;
    GBufferTexel g = decode_gbuffer(texelFetch(base_color_image, at, 0), texelFetch(normal_image, at, 0).xy,
                                    texelFetch(material_image, at, 0));
    bool inside = pixel == at, strong = inside && depth > 0.0 && reflects_strongly(g.roughness, g.reflectivity);
    if (inside && !strong) imageStore(ambient_image, pixel, vec4(0.0));
    // A loop, not a condition: devices that are processors run both sides of a condition.
    if (strong) flags |= add_ambient(pixel, depth, g, s);
  } while (++k < count);  // tested at the end: a processor goes once more through a loop that tests first
  if (kMirrors == 0u) return;
  imageStore(mirror_image, texel, uvec4(encode_mirror_surface(s, texel), 0u, 0u));
  if (flags == 0u) return;
  ivec2 place = texel / GLOAM_REFLECTION_GROUP;
  uint row = (reflection.size.x + GLOAM_REFLECTION_GROUP - 1u) / GLOAM_REFLECTION_GROUP;
  uint tile = uint(place.y) * row + uint(place.x);
  atomicOr(tile_flags[tile], flags);
  atomicMax(tile_roughness[tile], max(uint(s.roughness * 255.0 + 0.5), 1u));
}
