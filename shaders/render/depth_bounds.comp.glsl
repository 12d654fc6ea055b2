// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Hierarchical depth, first level: minimum and maximum depth of each 8×8 tile of the geometry buffer, sky excluded. A
// tile with only sky gets (1, 0). Reversed Z: the maximum is the nearest.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, rg32f) uniform writeonly image2D bounds_image;

// One thread per tile: no shared memory, no order of reduction, exact for any subgroup width.
void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 tiles = imageSize(bounds_image);
  if (any(greaterThanEqual(tile, tiles))) return;
  vec2 texel = 1.0 / vec2(textureSize(depth_image, 0));
  float nearest = 0.0, farthest = 1.0;
  for (int i = 0; i < 16; ++i) {
    // The corner that four texels share. Where the tile exceeds the image, the sampler repeats the border texels.
    vec2 corner = vec2(tile * 8 + ivec2(i & 3, i >> 2) * 2 + 1);
    vec4 d = textureGather(depth_image, corner * texel);
    vec4 surface = mix(vec4(1.0), d, greaterThan(d, vec4(0.0)));
    nearest = max(nearest, max(max(d.x, d.y), max(d.z, d.w)));
    farthest = min(farthest, min(min(surface.x, surface.y), min(surface.z, surface.w)));
  }
  imageStore(bounds_image, tile, vec4(farthest, nearest, 0.0, 0.0));
}
