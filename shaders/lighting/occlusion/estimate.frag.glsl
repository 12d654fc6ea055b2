// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/occlusion_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Share of the hemisphere above a surface, weighted by the cosine, that other surfaces within 1 m hide. The hemisphere
// is cut into slices through the view direction. In each slice the angles are divided into 32 sectors of equal weight,
// and each sample of the depth image hides the sectors that a body of a fixed thickness behind it covers. The integral
// over a slice is that of Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion"; the
// sectors are those of Therrien et al. 2023, "Screen Space Indirect Lighting with Visibility Bitmask", here of equal
// weight instead of equal angle, so that their number is the integral.
//
// The hemisphere is that above the drawn triangle: a plane with a normal map hides nothing of itself.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(push_constant, scalar) uniform Occlusion { OcclusionConstants occlusion; };

layout(location = 0) out float out_hidden;

const int kSlices = 2;
const int kSteps = 6;              // along each side of a slice
const float kThickness_m = 0.5;    // of bodies, along the view direction
const float kLeastSine = 0.03;     // of a sample's elevation: rounded depths lie up to this above their plane
const float kGreatestReach = 1.0;  // of the picture's height
const float kHalfPi = 1.57079632679;

struct Slice {
  vec3 to_eye;
  vec3 normal;
  float gamma;  // angle of the normal in the slice from to_eye
  float first;  // signed_weight() at the lower end
  float total;  // weight of all angles
};

// ∫ cos(t − gamma) |sin t| dt from 0 to `angle`.
float signed_weight(float gamma, float angle) {
  return 0.25 * sign(angle) * (cos(gamma) - cos(2.0 * angle - gamma) + 2.0 * angle * sin(gamma));
}

// Share of the slice's weight below the direction of `offset`. side: 1 or −1.
float share_below(Slice s, vec3 offset, float side) {
  float angle = side * acos(clamp(dot(offset, s.to_eye) * inversesqrt(dot(offset, offset)), -1.0, 1.0));
  angle = clamp(angle, s.gamma - kHalfPi, s.gamma + kHalfPi);
  return clamp((signed_weight(s.gamma, angle) - s.first) / s.total, 0.0, 1.0);
}

// Sectors of the slice that a sample hides. offset: from the surface to the sample.
uint hidden_sectors(Slice s, vec3 offset, float side) {
  float square = dot(offset, offset), reach = occlusion.metre;
  float front = share_below(s, offset, side);
  float back = share_below(s, offset - (kThickness_m * occlusion.metre) * s.to_eye, side);
  uint begin = uint(32.0 * min(front, back) + 0.5), end = uint(32.0 * max(front, back) + 0.5);
  uint bits = end - begin >= 32u ? ~0u : ((1u << (end - begin)) - 1u) << min(begin, 31u);
  bool hides = square <= reach * reach && dot(offset, s.normal) > kLeastSine * sqrt(square);
  return hides && begin < 32u ? bits : 0u;
}

Slice slice_along(vec3 to_eye, vec3 normal, vec3 along, out float weight) {
  Slice s;
  s.to_eye = to_eye;
  s.normal = normal;
  vec3 axis = normalize(cross(along, to_eye));
  vec3 in_slice = normal - axis * dot(normal, axis);
  float size = max(length(in_slice), 1e-6);
  float cosine = clamp(dot(in_slice, to_eye) / size, -1.0, 1.0);
  s.gamma = dot(in_slice, along - to_eye * dot(along, to_eye)) < 0.0 ? -acos(cosine) : acos(cosine);
  // A triangle seen from its edge may have a normal that looks slightly away.
  s.gamma = clamp(s.gamma, -kHalfPi, kHalfPi);
  s.first = signed_weight(s.gamma, s.gamma - kHalfPi);
  s.total = max(signed_weight(s.gamma, s.gamma + kHalfPi) - s.first, 1e-6);
  weight = size * s.total;
  return s;
}

// One of four, different in each texel of 2 × 2.
uint pattern(uvec2 texel) { return (texel.x & 1u) + 2u * ((texel.x ^ texel.y) & 1u); }

void main() {
  ivec2 last = ivec2(view.size) - 1;
  ivec2 pixel = min(GLOAM_OCCLUSION_SCALE * ivec2(gl_FragCoord.xy), last);
  float depth = texelFetch(depth_image, pixel, 0).r;
  out_hidden = 0.0;
  if (depth <= 0.0) return;
  vec3 position = relative_position(view, vec2(pixel), depth);
  vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
  vec3 to_eye = normalize(to_viewer(view, position));
  float pixel_side = length(relative_position(view, vec2(pixel) + vec2(1.0, 0.0), depth) - position);
  float reach = min(occlusion.metre / pixel_side, kGreatestReach * float(view.size.y));
  if (reach < 2.0) return;  // 1 m is less than two pixels
  uint at = pattern(uvec2(gl_FragCoord.xy));
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    float angle = 2.0 * kHalfPi * (float(i) + 0.25 * float(at)) / float(kSlices);
    vec2 direction = vec2(cos(angle), sin(angle));
    float weight;
    vec3 along = relative_position(view, vec2(pixel) + direction, depth) - position;
    Slice s = slice_along(to_eye, normal, along, weight);
    uint sectors = 0u;
    for (int k = 0; k < 2 * kSteps; ++k) {
      float side = k < kSteps ? 1.0 : -1.0;
      float share = (float(k % kSteps) + 0.25 * (float(at ^ 1u) + 1.0)) / float(kSteps);
      ivec2 there = pixel + ivec2(round(side * direction * (1.0 + (reach - 1.0) * share * sqrt(share))));
      if (any(lessThan(there, ivec2(0))) || any(greaterThan(there, last))) continue;
      float there_depth = texelFetch(depth_image, there, 0).r;
      if (there_depth <= 0.0) continue;
      sectors |= hidden_sectors(s, relative_position(view, vec2(there), there_depth) - position, side);
    }
    sum += weight * float(bitCount(sectors));
    weights += weight;
  }
  out_hidden = sum / (32.0 * weights);
}
