// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_GLOSSY_LINES_GLSL
#define GLOAM_SHADERS_REFLECTIONS_GLOSSY_LINES_GLSL

#include "shaders/reflections/passes/blur_width.glsl"

// Separable filters: a workgroup filters GLOAM_BLUR_GROUP texels of a row or a column and loads each texel that they
// need once into shared memory. Include this after the uniforms `view` and `reflection`.

layout(local_size_x = GLOAM_BLUR_GROUP) in;

const int kSegment = GLOAM_BLUR_GROUP + 2 * GLOAM_MOST_BLUR_RADIUS;  // a multiple of GLOAM_BLUR_GROUP

// Texel `i` of the workgroup's segment; 0 is `blur_radius` texels before the first filtered one.
ivec2 segment_texel(int i) {
  int along = int(gl_WorkGroupID.x) * GLOAM_BLUR_GROUP + i - int(reflection.blur_radius);
  int line = int(gl_WorkGroupID.y);
  return kColumns != 0u ? ivec2(line, along) : ivec2(along, line);
}

#endif
