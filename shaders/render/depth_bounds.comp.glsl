// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Hierarchical depth, first level: minimum and maximum depth of each 8×8 tile of the geometry buffer, sky left out.
// A tile of nothing but sky gets (1, 0). Reversed Z: the maximum is the nearest.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, rg32f) uniform writeonly image2D bounds_image;

// One thread a tile: no shared memory, no order of reduction, exact for any subgroup width.
void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 tiles = imageSize(bounds_image);
  if (any(greaterThanEqual(tile, tiles))) return;
  ivec2 size = textureSize(depth_image, 0);
  float nearest = 0.0, farthest = 1.0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      ivec2 texel = min(tile * 8 + ivec2(x, y), size - 1);
      float d = texelFetch(depth_image, texel, 0).r;
      nearest = max(nearest, d);
      farthest = min(farthest, d > 0.0 ? d : 1.0);
    }
  }
  imageStore(bounds_image, tile, vec4(farthest, nearest, 0.0, 0.0));
}
