// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_COMPOSITE_UPSCALE_GLSL
#define GLOAM_SHADERS_REFLECTIONS_COMPOSITE_UPSCALE_GLSL

#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_api.glsl"

// Looks the reflection of a pixel up in the reflection images. Include this after the uniforms `view` and `reflection`,
// the images color_image, surface_image and mirror_image, and the constants kBumpy and kCentered.

struct Mirrored {
  vec3 light;        // premultiplied by the confidence
  float confidence;  // 0: nothing reflects here
  float distance_m;  // along the mirrored ray; of the nearest texel, or the mean where the texels show one surface
};

// The surface that a reflection is looked up for, and the depths of its plane: linear over the picture, in steps of the
// tolerance.
struct MirrorPixel {
  vec3 position;  // camera-relative
  vec2 pixel;
  float roughness;
  float per_depth;  // steps for a difference in depth
  float depth;      // of the pixel, in steps
  vec2 slope;       // steps for a pixel to the right and down
};

const float kOneSurface = 1.25;        // ratio of distances up to which texels show one surface
const float kPlaneStep = 0.01;         // of the depth, orthographic: units: how far off a plane its texels may lie
const float kRoughnessStep = 0.03;     // difference of roughness up to which texels are of one material
const float kLeastTexelWeight = 1e-4;  // of texels of other surfaces: they count only where there is no other texel

MirrorPixel mirror_pixel(ivec2 pixel, float depth, vec3 position, vec3 face_normal, float roughness) {
  MirrorPixel p;
  p.position = position;
  p.pixel = vec2(pixel);
  p.roughness = roughness;
  vec2 slope = vec2(dot(face_normal, view.ray_dx.xyz), dot(face_normal, view.ray_dy.xyz));
  if (view.orthographic != 0u) {
    float per_step = 1.0 / (kPlaneStep * reflection.unit_m), along = dot(face_normal, view.ray_forward.xyz);
    p.per_depth = view.ray_dy.w * per_step;
    p.slope = slope * (-per_step / (abs(along) < 1e-3 ? 1e-3 : along));
  } else {
    // 1 / depth is linear in the picture, and so is reversed depth.
    vec3 ray = view.ray_base.xyz + p.pixel.x * view.ray_dx.xyz + p.pixel.y * view.ray_dy.xyz;
    float along = dot(face_normal, ray);
    p.per_depth = 1.0 / (kPlaneStep * max(depth, 1e-30));
    p.slope = slope / (kPlaneStep * (abs(along) < 1e-5 ? 1e-5 : along));
  }
  p.depth = depth * p.per_depth;
  return p;
}

struct MirrorTexel {
  ivec2 place;
  vec4 color;  // premultiplied by the confidence in a
  float roughness;
  float distance_m;
  float depth;  // reversed Z of the pixel that it stands for
  ivec2 pixel;  // that pixel
};

MirrorTexel fetch_texel(ivec2 texel) {
  ivec2 place = min(texel, ivec2(reflection.size) - 1);
  vec4 surface = texelFetch(surface_image, place, 0);
  uvec2 stored = texelFetch(mirror_image, place, 0).xy;
  return MirrorTexel(place, texelFetch(color_image, place, 0), surface.y,
                     reflection.unit_m * unpack_hit_distance(surface.zw), uintBitsToFloat(stored.x),
                     mirror_pixel_of(stored, place));
}

// Four texels in a square.
struct MirrorTexels {
  MirrorTexel upper_left, upper_right, lower_left, lower_right;
};

MirrorTexels fetch_texels(ivec2 upper_left) {
  return MirrorTexels(fetch_texel(upper_left), fetch_texel(upper_left + ivec2(1, 0)),
                      fetch_texel(upper_left + ivec2(0, 1)), fetch_texel(upper_left + ivec2(1)));
}

// How far a texel belongs to the pixel's surface, 0…1: it lies in its plane, and is as rough.
float same_surface(MirrorPixel p, MirrorTexel t) {
  float apart = t.depth * p.per_depth - p.depth - dot(p.slope, vec2(t.pixel) - p.pixel);
  float rougher = (t.roughness - p.roughness) / kRoughnessStep;
  return 1.0 / (1.0 + apart * apart + rougher * rougher);
}

struct MirroredSum {
  vec4 light;
  float weight, greatest_weight;
  float nearest_m, mean_m, least_m, greatest_m;  // distances: of the heaviest texel, weighted, of all that count
};

void add_texel(inout MirroredSum sum, MirrorPixel p, MirrorTexel t, float share) {
  float weight = (share + kLeastTexelWeight) * (same_surface(p, t) + kLeastTexelWeight);
  weight = t.roughness > 0.0 ? weight : 0.0;
  sum.light += weight > 0.0 ? weight * t.color : vec4(0.0);  // texels of other tiles hold no values
  sum.weight += weight;
  sum.nearest_m = weight > sum.greatest_weight ? t.distance_m : sum.nearest_m;
  sum.mean_m += weight * t.distance_m;
  sum.least_m = weight > 1e-3 ? min(sum.least_m, t.distance_m) : sum.least_m;
  sum.greatest_m = weight > 1e-3 ? max(sum.greatest_m, t.distance_m) : sum.greatest_m;
  sum.greatest_weight = max(sum.greatest_weight, weight);
}

// Between four texels, those that reflect. part: 0…1 from the left and upper ones to the right and lower ones.
Mirrored between_texels(MirrorPixel p, MirrorTexels t, vec2 part) {
  MirroredSum sum = MirroredSum(vec4(0.0), 0.0, 0.0, 0.0, 0.0, 1e30, 0.0);
  add_texel(sum, p, t.upper_left, (1.0 - part.x) * (1.0 - part.y));
  add_texel(sum, p, t.upper_right, part.x * (1.0 - part.y));
  add_texel(sum, p, t.lower_left, (1.0 - part.x) * part.y);
  add_texel(sum, p, t.lower_right, part.x * part.y);
  vec4 light = sum.weight > 0.0 ? sum.light / sum.weight : vec4(0.0);
  bool one_surface = sum.weight > 0.0 && sum.greatest_m < kOneSurface * sum.least_m;
  return Mirrored(light.rgb, light.a, one_surface ? sum.mean_m / sum.weight : sum.nearest_m);
}

// The same at any point. at: pixels of the view, centres at whole numbers.
Mirrored fetch_mirrored(MirrorPixel p, vec2 at) {
  vec2 shown = reflection.scale == 1u ? vec2(0.0) : kCentered != 0u ? vec2(0.5) : vec2(0.0);
  vec2 texel = clamp((at - shown) / float(reflection.scale), vec2(0.0), vec2(reflection.size - 1u));
  ivec2 base = ivec2(texel);
  return between_texels(p, fetch_texels(base), texel - vec2(base));
}

// The pixel at which a horizontal surface shows what this one shows: its ray ends at a point whose mirror image in the
// horizontal plane through the pixel is projected to the screen.
vec2 bent_pixel(vec2 pixel, vec3 position, vec3 normal, float distance_m) {
  vec3 ray = reflect(-normalize(to_viewer(view, position)), normal);
  vec3 image = position + vec3(ray.x, -ray.y, ray.z) * distance_m;
  vec4 clip = view.clip_from_relative * vec4(image, 1.0);
  vec2 at = (0.5 + clip.xy / (clip.w > 0.0 ? clip.w : 1.0) * vec2(0.5, -0.5)) * vec2(view.size) - 0.5;
  return clip.w > view.near_m || view.orthographic != 0u ? at : pixel;
}

const float kMuchCloser = 0.5;  // share of the old fetch's distance below which the bent one has met something else
const float kMostBend = 0.25;   // of the picture's height

// texels: fetch_texels() of the pixel's block. Where texels stand for first pixels, all pixels of a block lie between
// the same four.
Mirrored mirrored_at(ivec2 pixel, MirrorPixel p, MirrorTexels texels, vec3 normal) {
  vec2 part = vec2(pixel - texels.upper_left.place * int(reflection.scale)) / float(reflection.scale);
  Mirrored straight = kCentered != 0u ? fetch_mirrored(p, vec2(pixel)) : between_texels(p, texels, part);
  if (kBumpy == 0u) return straight;
  if (straight.confidence <= 0.0 || normal.y >= GLOAM_FLAT_MIRROR) return straight;
  vec2 bend = bent_pixel(vec2(pixel), p.position, normal, straight.distance_m) - vec2(pixel);
  float most = kMostBend * float(view.size.y), length_px = length(bend);
  if (length_px > most) bend *= most / length_px;
  Mirrored bent = fetch_mirrored(p, vec2(pixel) + bend);
  bool other = bent.confidence <= 0.0 || bent.distance_m < kMuchCloser * straight.distance_m;
  if (other) return straight;
  return bent;
}

#endif
