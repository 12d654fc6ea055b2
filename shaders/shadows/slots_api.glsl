// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SLOTS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_SLOTS_API_GLSL

// Visibility slots of final lists. Reserved tiles take slots [0, reserved_slots), of which there are enough for all of
// their lights; other tiles take the rest. Include it after declaring `final_grid` (FinalGrid) and `counters`
// (ShadowListCounters).

// Takes a slot. reserved: whether the tile is reserved. GLOAM_NO_ROOM if none is left.
uint take_free_slot(bool reserved) {
  uint slot = atomicAdd(counters.slots, 1u), end = final_grid.slot_capacity;
  if (final_grid.reserved_slots != 0u) {
    if (reserved) {
      slot = atomicAdd(counters.reserved_slots, 1u);
      end = final_grid.reserved_slots;
    } else {
      slot = final_grid.reserved_slots + atomicAdd(counters.other_slots, 1u);
    }
  }
  return slot < end ? slot : GLOAM_NO_ROOM;
}

#endif
