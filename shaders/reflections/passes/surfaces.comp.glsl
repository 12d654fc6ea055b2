// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/environment_api.glsl"
#include "shaders/lighting/mirror_share_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Finds the surfaces that reflect, for each texel of the reflection images: what those that reflect weakly mirror of
// their surroundings (SurroundingsOutput), and which tiles hold others.

layout(local_size_x = GLOAM_REFLECTION_GROUP, local_size_y = GLOAM_REFLECTION_GROUP) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D material_image;
layout(set = 0, binding = 5) uniform sampler2D depth_image;
layout(set = 0, binding = 6, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D far_image;
layout(set = 0, binding = 8, scalar) buffer Flags { uint tile_flags[]; };     // GLOAM_TILE_… bits of each tile
layout(set = 0, binding = 9, rgba8) uniform writeonly image2D surface_image;  // cleared: no texel has a reflection yet

layout(constant_id = 0) const uint kMirrors = 1u;  // 0: there are no mirrored images

#define GLOAM_SURROUNDINGS_BINDING 24
#include "shaders/lighting/surroundings_api.glsl"

// The pixels of a texel, and which of them reflect strongly. Components in the order of the pixels: rows from the top.
bvec4 strong_pixels(ivec2 texel) {
  vec2 at = (vec2(texel * 2) + 1.0) * view.inverse_size;
  vec4 roughness = textureGather(material_image, at, 0).wzxy, reflectivity = textureGather(material_image, at, 3).wzxy;
  vec4 material = texelFetch(material_image, texel, 0);
  if (reflection.scale == 1u) roughness = vec4(material.x);
  if (reflection.scale == 1u) reflectivity = vec4(material.w);
  return bvec4(reflects_strongly(roughness.x, reflectivity.x), reflects_strongly(roughness.y, reflectivity.y),
               reflects_strongly(roughness.z, reflectivity.z), reflects_strongly(roughness.w, reflectivity.w));
}

// What the surface at a pixel mirrors of its surroundings.
vec3 weakly_mirrored(ivec2 pixel, float depth) {
  vec4 material = texelFetch(material_image, pixel, 0);
  ShadingPoint p;  // the parts that the probes use
  p.normal = unpack_normal(texelFetch(normal_image, pixel, 0).x);
  p.position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  p.to_eye = normalize(to_viewer(view, p.position));
  return far_radiance(p, mirrored_radiance(environment, p, material.x), material.x);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(texel), reflection.size))) return;
  bvec4 strong = strong_pixels(texel);
  ivec2 weak = texel * int(reflection.scale) + (!strong.x   ? ivec2(0)
                                                : !strong.y ? ivec2(1, 0)
                                                : !strong.z ? ivec2(0, 1)
                                                            : ivec2(1));
  weak = min(weak, ivec2(view.size) - 1);
  float depth = all(strong) ? 0.0 : texelFetch(depth_image, weak, 0).r;
  vec3 light = vec3(0.0);
  if (depth > 0.0) light = weakly_mirrored(weak, depth);
  imageStore(far_image, texel, vec4(min(light, vec3(65504.0)), 1.0));
  if (kMirrors != 0u) imageStore(surface_image, texel, vec4(0.0));
  uint row = (reflection.size.x + GLOAM_REFLECTION_GROUP - 1u) / GLOAM_REFLECTION_GROUP;
  if (any(strong)) atomicOr(tile_flags[gl_WorkGroupID.y * row + gl_WorkGroupID.x], GLOAM_TILE_STRONG);
}
