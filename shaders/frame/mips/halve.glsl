// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_FRAME_MIPS_HALVE_GLSL
#define GLOAM_SHADERS_FRAME_MIPS_HALVE_GLSL

// Writes a mip of all layers from the next larger one: each texel is the mean of 2×2 texels. Of an odd size the last
// row or column is left out; a side of one texel counts twice. GLOAM_MIP_FORMAT: storage format of the image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray larger;
layout(set = 0, binding = 1, GLOAM_MIP_FORMAT) writeonly uniform image2DArray smaller;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(texel.xy, imageSize(smaller).xy))) return;
  ivec2 first = 2 * texel.xy;
  ivec2 second = min(first + 1, textureSize(larger, 0).xy - 1);
  vec4 sum = texelFetch(larger, ivec3(first, texel.z), 0);
  sum += texelFetch(larger, ivec3(second.x, first.y, texel.z), 0);
  sum += texelFetch(larger, ivec3(first.x, second.y, texel.z), 0);
  sum += texelFetch(larger, ivec3(second, texel.z), 0);
  imageStore(smaller, texel, 0.25 * sum);
}

#endif
