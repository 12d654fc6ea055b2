// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/lod/lod_shared.h"

// Turns the histogram of the sort into the arguments of the draws and of the dispatches that follow. One thread.

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, scalar) uniform Lod { GrassLod lod; };
layout(set = 0, binding = 1, scalar) readonly buffer Bins { uint bins[257]; };  // exclusive prefix sum over the keys
layout(set = 0, binding = 2, scalar) writeonly buffer Draws { GrassDraws draws; };
layout(set = 0, binding = 3, scalar) writeonly buffer Dispatch { GrassDispatch dispatch; };
layout(set = 0, binding = 4, scalar) writeonly buffer Casting { GrassCasting casting; };

GrassDraw draw_of(uint blades, uint segments, uint first_index) {
  uint instances = (blades + GLOAM_GRASS_DRAW_BLADES - 1u) / GLOAM_GRASS_DRAW_BLADES;
  return GrassDraw(6u * segments * GLOAM_GRASS_DRAW_BLADES, instances, first_index, 0u, 0u);
}

void main() {
  uint live = bins[lod.threshold + 1u], first = 0u;
  for (int i = 0; i < GLOAM_GRASS_CLASSES; ++i) {
    uint end = min(bins[lod.class_keys[i] + 1u], live), count = max(end, first) - first;
    draws.draws[i] = draw_of(count, lod.class_segments[i], lod.class_indices[i]);
    draws.class_first[i] = first;
    draws.class_count[i] = count;
    first += count;
  }
  draws.cast_count = lod.cast_key < GLOAM_GRASS_CULLED ? min(bins[lod.cast_key + 1u], live) : 0u;
  casting =
      GrassCasting(draw_of(0u, lod.class_segments[GLOAM_GRASS_CAST_CLASS], lod.class_indices[GLOAM_GRASS_CAST_CLASS]),
                   0u, float(lod.cast_every), 0u, uvec3(0u, 1u, 1u));
  draws.live = live;
  draws.units_per_metre = lod.units_per_metre;
  draws.blade_groups = uvec3((live + 63u) / 64u, 1u, 1u);
  dispatch = GrassDispatch(0u, uvec3(0u, 1u, 1u));
}
