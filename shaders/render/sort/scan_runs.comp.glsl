// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// The same as scan_blocks.comp, for devices that run the threads of a workgroup in turn: one thread per four bins, and
// no barrier.

layout(local_size_x = GLOAM_SORT_RUN_THREADS) in;

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) buffer Counters { uvec4 counters[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Totals { uvec4 totals[]; };

void main() {
  uint quad = gl_GlobalInvocationID.x;
  uvec4 before = uvec4(0u);
  for (uint column = 0u; column < c.columns; ++column) {
    uint at = column * (GLOAM_SORT_BINS / 4u) + quad;
    uvec4 counted = counters[at];
    counters[at] = before;
    before += counted;
  }
  totals[quad] = before;
}
