// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/glare/glare_shared.h"
#include "shaders/lighting/scattered_light_api.glsl"

// The light of a picture as it is shown, with what the lens scatters.

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Show { GlareShow c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1) uniform sampler2D scattered_image;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D shown_image;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, c.size))) return;
  vec4 light = texelFetch(lit_image, ivec2(pixel), 0);
  vec2 at = (vec2(pixel) + 0.5) * c.uv_scale + c.uv_offset;
  vec3 scattered = textureLod(scattered_image, at, 0.0).rgb;
  imageStore(shown_image, ivec2(pixel), vec4(with_scattered_light(light.rgb, scattered, c.share), light.a));
}
