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

// Shares of the mirrored light. Up to the first, a surface shows the mean of the probes about the direction; from the
// second on, their maps are looked up. What is mirrored by a fiftieth does not show details.
const float kFaint = 0.02;
const float kClear = 0.04;

// About the share of its surroundings that a rough dielectric mirrors (specular_share()): 0.03 straight on.
float about_share(float n_dot_v) {
  float grazing = (1.0 - n_dot_v) * (1.0 - n_dot_v);
  return 0.03 + 0.4 * grazing * grazing;
}

struct ProbeMean {
  vec3 above, below;
  float covered;
};

void add_mean(inout ProbeMean mean, ProbeRow probe, vec3 position, vec3 normal) {
  float share = facing_share(probe, place_in_probe(probe, position), normal) * (1.0 - mean.covered);
  mean.covered += share;
  mean.above += share * probe.above.rgb;
  mean.below += share * probe.below.rgb;
}

ProbeMean probe_mean(vec3 position, vec3 normal) {
  ProbeMean mean = ProbeMean(vec3(0.0), vec3(0.0), 0.0);
#define GLOAM_ADD_MEAN(row) add_mean(mean, row, position, normal)
  GLOAM_FOR_EACH_PROBE(GLOAM_ADD_MEAN)
  return mean;
}

// What the surface at a pixel mirrors of its surroundings.
vec3 weakly_mirrored(ivec2 pixel, float depth) {
  vec4 material = texelFetch(material_image, pixel, 0);
  ShadingPoint p;  // the parts that the probes use
  p.normal = unpack_normal(texelFetch(normal_image, pixel, 0).x);
  p.position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  p.to_eye = normalize(to_viewer(view, p.position));
  vec3 around = mirrored_radiance(environment, p, material.x);
  if (kProbes == 0u) return around * surroundings.fog_through + surroundings.fog_light;
  float share = about_share(clamp(dot(p.normal, p.to_eye), 0.0, 1.0)) * material.w;
  float details = clamp((share - kFaint) / (kClear - kFaint), 0.0, 1.0);
  ProbeMean mean = probe_mean(p.position, p.normal);
  vec3 light = mix(mean.below, mean.above, 0.5 + 0.5 * reflect(-p.to_eye, p.normal).y);
  light = light * surroundings.probe_scale + around * (1.0 - mean.covered);
  light = light * surroundings.fog_through + surroundings.fog_light;
  if (details > 0.0)
    light = mix(light, far_radiance(p, around, material.x), details);
  return light;
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
