// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_SCREEN_SPACE_RAYS_GLSL
#define GLOAM_SHADERS_REFLECTIONS_SCREEN_SPACE_RAYS_GLSL

#include "shaders/lighting/environment_api.glsl"
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Screen-space reflections (reflections tier 1): colour of the lit picture where the mirrored ray passes behind the
// depth image, and the confidence that this is what the ray meets. With GLOAM_BLENDED_LAYER the ray is followed a
// second time, through BlendedLayer, and what it meets there is laid over what it meets behind that.

layout(constant_id = 0) const uint kHierarchical = 0u;
layout(constant_id = 1) const uint kPixelNormals = 0u;  // 1: rays follow the normals of pixels

#define GLOAM_MOST_STEPS 96u

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform usampler2D mirror_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform sampler2D depth_bounds;
layout(set = 0, binding = 6) uniform sampler2D lit_image;
layout(set = 0, binding = 14) uniform sampler2D base_color_image;
layout(set = 0, binding = 15) uniform sampler2D material_image;
layout(set = 0, binding = 16) uniform sampler2D ambient_image;
layout(set = 0, binding = 17, scalar) uniform Environment { EnvironmentConstants environment; };
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D color_image;   // radiance, confidence
layout(set = 0, binding = 8, rgba8) uniform writeonly image2D distance_image;  // see ScreenSpaceHits

#ifdef GLOAM_BLENDED_LAYER
layout(set = 0, binding = 12) uniform sampler2D blended_light;
layout(set = 0, binding = 13) uniform sampler2D blended_depth;
#endif

#define GLOAM_MIRROR_TILES 9
#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/passes/pixel_normal.glsl"
#include "shaders/reflections/passes/screen_space_march.glsl"
#define GLOAM_LIT_AT(pixel) texelFetch(lit_image, pixel, 0).rgb
#define GLOAM_SURROUNDINGS_BINDING 24
#include "shaders/reflections/passes/hit_light.glsl"

const float kEdgeShare = 0.08;       // width of the fade at the border of the screen, as a share of it
const float kAwayFromCamera = 0.35;  // cosine between ray and direction to the camera where confidence begins to fall
const float kTowardCamera = 0.85;    // and where it ends
const float kHighStart = 0.75;       // share of the reach where confidence begins to fall

// Whether a ray is followed. Kernels of tests count the answers.
#ifndef GLOAM_FOLLOWED
#define GLOAM_FOLLOWED(followed) (followed)
#endif

struct Hit {
  vec3 light;
  float confidence;
  float distance_m;
  bool blended;  // blended surfaces are in `light`
};

// Confidence in the ray's direction, 0 if it turns toward the camera: there the picture shows the far sides of what it
// meets.
float away_from_camera(MirrorSurface s) {
  float toward = dot(s.direction, normalize(to_viewer(view, s.position)));
  return 1.0 - smoothstep(kAwayFromCamera, kTowardCamera, toward);
}

// Confidence in a hit `delta_m` behind the surface at `at` on the screen. away: away_from_camera(s).
float confidence_at(MirrorSurface s, float away, vec2 at, float delta_m, float distance_m) {
  vec2 edge = min(at, vec2(view.size) - at) * view.inverse_size;
  float inside = clamp(min(edge.x, edge.y) / kEdgeShare, 0.0, 1.0);
  float height = distance_m * s.direction.y / reflection.reach_m;
  return (1.0 - smoothstep(0.5, 1.0, delta_m / reflection.thickness_m)) * inside *
         (1.0 - smoothstep(kHighStart, 1.0, height)) * away;
}

// The place where the ray passes behind the surface, found by binary search between bounds.x and bounds.y.
float refined(ScreenRay ray, vec2 bounds) {
  for (uint i = 0u; i < reflection.refine; ++i) {
    float middle = 0.5 * (bounds.x + bounds.y);
    bool is_behind = behind_m(ray, middle) > 0.0;
    bounds = is_behind ? vec2(bounds.x, middle) : vec2(middle, bounds.y);
  }
  return bounds.y;
}

Hit trace(MirrorSurface s, float away, ScreenRay ray) {
  float depth_m = view_depth(view, s.position);
  vec2 bounds = kHierarchical != 0u ? march_hierarchical(ray) : march_constant(ray, depth_m);
  bool met = ray.length_m > 0.0 && bounds.x < bounds.y;
  float place = refined(ray, bounds);
  vec3 at = ray.from + ray.step * place;
  ivec2 pixel = clamp(ivec2(at.xy), ivec2(0), ivec2(view.size) - 1);
  Hit hit;
  hit.blended = false;
  hit.distance_m = distance_at(ray, place);
  hit.light = vec3(0.0);
  // The side of the surface that the ray meets must be the one that the camera sees.
  vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
  float faces = smoothstep(0.0, 0.1, -dot(normal, s.direction));
  hit.confidence = confidence_at(s, away, at.xy, max(behind_m(ray, place), 0.0), hit.distance_m) * faces;
  if (!met) hit.confidence = 0.0;
  if (hit.confidence > 0.0) hit.light = light_along(pixel, s.direction);
  return hit;
}

#ifdef GLOAM_BLENDED_LAYER
// Lays the blended surfaces that the ray meets before `hit` over it. Blended surfaces have no side that they hide.
Hit with_blended(MirrorSurface s, float away, ScreenRay ray, Hit hit) {
  through_blended = true;
  vec2 bounds = march_constant(ray, view_depth(view, s.position));
  bool met = ray.length_m > 0.0 && bounds.x < bounds.y;
  float place = refined(ray, bounds);
  vec3 at = ray.from + ray.step * place;
  ivec2 pixel = clamp(ivec2(at.xy), ivec2(0), ivec2(view.size) - 1);
  float distance_m = distance_at(ray, place);
  float delta_m = max(behind_m(ray, place), 0.0);
  through_blended = false;
  float confidence = met && (hit.confidence == 0.0 || distance_m < hit.distance_m)
                         ? confidence_at(s, away, at.xy, delta_m, distance_m)
                         : 0.0;
  vec4 layer = texelFetch(blended_light, pixel, 0);
  float share = clamp(layer.a, 0.0, 1.0) * confidence, rest = (1.0 - share) * hit.confidence, all = share + rest;
  if (share > 0.0) {
    hit.light = clean((clean(layer.rgb) * confidence + hit.light * rest) / all);
    hit.distance_m = share > rest ? distance_m : hit.distance_m;
    hit.confidence = all;
    hit.blended = true;
  }
  return hit;
}
#endif

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  MirrorSurface s = decode_mirror_surface(texelFetch(mirror_image, texel, 0).xy, texel);
  Hit hit = Hit(vec3(0.0), 0.0, 0.0, false);
  if (kPixelNormals != 0u) follow_normal(s);
  float away = away_from_camera(s);
  if (s.share > 0.0 && GLOAM_FOLLOWED(away > 0.0)) {
    ScreenRay ray = screen_ray(s.position, s.direction);
    hit = trace(s, away, ray);
#ifdef GLOAM_BLENDED_LAYER
    hit = with_blended(s, away, ray, hit);
#endif
  }
  imageStore(color_image, texel, vec4(hit.confidence > 0.0 ? hit.light : vec3(0.0), hit.confidence));
  imageStore(distance_image, texel,
             vec4(pack_hit_distance(hit.distance_m / reflection.unit_m), hit.blended ? 1.0 : 0.0, 0.0));
}

#endif
