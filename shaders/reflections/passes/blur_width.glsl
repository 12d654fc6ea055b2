// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_GLOSSY_WIDTH_GLSL
#define GLOAM_SHADERS_REFLECTIONS_GLOSSY_WIDTH_GLSL

#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_api.glsl"

// Width of the glossy blur. Include this after the uniforms `view` and `reflection`.

#ifndef GLOAM_WIDTH_WITHOUT_CONSTANT
layout(constant_id = 0) const uint kColumns = 0u;  // 1: along columns, 0: along rows
#endif

// Direction of the lines. Components are chosen one by one: Mesa 22.3 evaluates a choice between constant vectors
// wrongly.
const ivec2 kAlong = ivec2(kColumns != 0u ? 0 : 1, kColumns != 0u ? 1 : 0);

bool is_inside(ivec2 texel) {
  return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(reflection.size)));
}

// Standard deviation of the core of the blur at a texel, in texels, for spread 1 and a width factor of 1.
float blur_unit(ivec2 texel) {
  if (kColumns != 0u) return reflection.blur_scale;
  if (reflection.pixel_roughness == 0u) return reflection.blur_scale * reflection.blur_across;
  // The lobe of a rough floor keeps its angle along the vertical plane of the ray; across, it narrows with the sine of
  // the angle between ray and floor.
  vec3 ray = view_ray(view, (vec2(texel) + 0.5) * float(reflection.scale) - 0.5);
  return reflection.blur_scale * max(abs(ray.y) * inversesqrt(max(dot(ray, ray), 1e-30)), reflection.blur_across);
}

// Width factor of a surface.
float blur_factor(float roughness) { return reflection.pixel_roughness == 0u ? 1.0 : roughness * roughness; }

// Standard deviation of the core of the blur at a texel, in texels. spread, roughness: 0…1.
float blur_sigma(ivec2 texel, float spread, float roughness) {
  return blur_unit(texel) * spread * blur_factor(roughness);
}

const float kReach = 2.0;        // standard deviations after which the Gaussian is cut
const float kLeastSigma = 0.15;  // texels; below, the neighbours' weight is less than a half float's step

int blur_reach(float sigma) { return min(int(ceil(kReach * sigma)), int(reflection.blur_radius)); }

// The same of the wider one of the two Gaussians whose core has this standard deviation.
int widest_reach(float sigma) { return blur_reach(max(1.0, reflection.blur_tail) * sigma); }

// One of the two Gaussians of a lobe along a line of texels.
struct BlurPart {
  int reach;      // texels on each side; 0: the texel itself
  float falloff;  // the weight of a texel k texels away is 2^(falloff · k²)
};

BlurPart blur_part(float sigma) {
  return BlurPart(sigma > kLeastSigma ? blur_reach(sigma) : 0, -0.72134752 / max(sigma * sigma, 1e-6));  // ½ log₂ e
}

float blur_weight(BlurPart part, int k) { return k <= part.reach ? exp2(part.falloff * float(k * k)) : 0.0; }

// The blur along columns writes the picture of the core, and below it that of the tail.
ivec2 tail_texel(ivec2 texel) { return texel + ivec2(0, reflection.size.y); }

#endif
