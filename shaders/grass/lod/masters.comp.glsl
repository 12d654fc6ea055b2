// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/blade_api.glsl"
#include "shaders/grass/lod/lod_shared.h"

// Lists the masters of live blades that have not reached this frame's step: each once, in any order. A view that comes
// later in the frame finds the stamps of an earlier one, so a master is simulated once a frame. Masters beyond the room
// of the dispatch are counted, keep their stamps and wait for a later frame.

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

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= draws.live) return;
  uint row = blades[i] / GLOAM_GRASS_PATCH_BLADES, index = blades[i] % GLOAM_GRASS_PATCH_BLADES;
  GrassPatchRow patch_row = patches[row];
  uint master = grass_master(blade_rows[patch_row.first_blade + index]);
  uint stamp = patch_row.first_place + master;
  uint reached = atomicExchange(stamps[stamp], steps.now);
  if (reached == steps.now) return;
  uint place = atomicAdd(dispatch.masters, 1u);
  if (place >= lod.most_masters) {
    stamps[stamp] = reached;
    return;
  }
  if (place % kGroupMasters == 0u) atomicAdd(dispatch.groups.x, 1u);
  uint missed = reached == GLOAM_GRASS_NO_STEP ? GLOAM_GRASS_NO_STEP : min(steps.now - reached, steps.frame_steps);
  master_list[place] = GrassMaster(row << 8 | master, missed);
}
