// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/blade_api.glsl"
#include "shaders/grass/lod/lod_shared.h"

// Lists the masters of live blades that have not reached this frame's step: each once, in any order. A view that comes
// later in the frame finds the stamps of an earlier one, so a master is simulated once a frame. Masters beyond the room
// of the dispatch are counted, keep their stamps and wait for a later frame. Masters of blades that are small in the
// picture run two or four steps at once, up to the last step whose number is a multiple of that; not near colliders,
// which may pass in a frame in which they do not step.

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kGroupMasters = 4u;  // masters of one workgroup of the simulation

layout(set = 0, binding = 0, scalar) uniform Steps { GrassSteps steps; };
layout(set = 0, binding = 1, scalar) readonly buffer Patches { GrassPatchRow patches[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Rows { GrassBladeRow blade_rows[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Blades { uint blades[]; };  // sorted
layout(set = 0, binding = 4, scalar) readonly buffer Draws { GrassDraws draws; };
layout(set = 0, binding = 5, scalar) buffer Stamps { uint stamps[]; };  // step that each master has reached
layout(set = 0, binding = 6, scalar) writeonly buffer Masters { GrassMaster master_list[]; };
layout(set = 0, binding = 8, scalar) uniform Lod { GrassLod lod; };
layout(set = 0, binding = 7, scalar) buffer Dispatch { GrassDispatch dispatch; };

uint stride_of(GrassPatchRow row, GrassBladeRow master) {
  GrassStem stem = grass_stem(row, master);
  float distance_m = lod.orthographic != 0u ? 1.0 : length(row.origin + grass_turned(row.turn, stem.root));
  float long_px = stem.length_m / max(lod.pixel_m * distance_m, 1e-9);
  uint stride = long_px < lod.stride_px * (1.0 / 3.0) ? 4u : long_px < lod.stride_px ? 2u : 1u;
  return row.colliders != 0u ? 1u : stride;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= draws.live) return;
  uint row = blades[i] / GLOAM_GRASS_PATCH_BLADES, index = blades[i] % GLOAM_GRASS_PATCH_BLADES;
  GrassPatchRow patch_row = patches[row];
  uint master = grass_master(blade_rows[patch_row.first_blade + index]);
  uint stride = stride_of(patch_row, blade_rows[patch_row.first_blade + master]);
  uint target = steps.now - steps.now % stride;
  uint stamp = patch_row.first_place + master;
  uint reached = atomicOr(stamps[stamp], 0u);
  bool fresh = reached == GLOAM_GRASS_NO_STEP;
  target = fresh ? steps.now : target;
  // An earlier view, or a frame in which the blade was near, may have gone beyond the target.
  if (!fresh && target - reached - 1u > 0x7FFFFFFFu) return;
  if (atomicCompSwap(stamps[stamp], reached, target) != reached) return;
  uint place = atomicAdd(dispatch.masters, 1u);
  if (place >= lod.most_masters) {
    stamps[stamp] = reached;
    return;
  }
  if (place % kGroupMasters == 0u) atomicAdd(dispatch.groups.x, 1u);
  uint missed = fresh ? GLOAM_GRASS_NO_STEP : min(target - reached, steps.frame_steps + stride - 1u);
  master_list[place] = GrassMaster(row << 8 | master, missed, stride);
}
