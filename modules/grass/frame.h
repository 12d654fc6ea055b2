// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/grass/knobs.h"
#include "modules/grass/lod/residency.h"
#include "shaders/grass/grass_shared.h"
#include "shaders/grass/lod/lod_shared.h"

namespace gloam {

/// Buffers of one world that live over frames; a slot has room for one patch.
struct GrassStore {
  BufferRef rows;    ///< GrassBladeRow, 256 per slot
  BufferRef stamps;  ///< uint: step that a master has reached, StoredPatches::slot_masters per slot
  BufferRef knots;   ///< vec4, 16 per master
  BufferRef previous_knots;
};

/// Patches of a view that have a slot, and the buffers of their world.
struct StoredPatches {
  std::vector<ResidentPatch> patches;  ///< nearest first
  std::uint32_t slot_masters = 0;      ///< masters for which a slot has room
  GrassStore store;
};

/// Rows and constants that the passes of a view read.
struct GrassInputs {
  std::uint32_t patches = 0;                             ///< number of patch rows
  std::uint32_t slot_masters = 0;                        ///< StoredPatches::slot_masters
  std::uint32_t group_masters = 0;                       ///< masters of one workgroup of the simulation
  SimulationThreads threads = SimulationThreads::blade;  ///< not `device`
  shaders::GrassLod lod;
  shaders::GrassSteps steps;
  gpu::Binding::BufferRange lod_range;   ///< `lod`
  gpu::Binding::BufferRange patch_rows;  ///< of StoredPatches::patches
  gpu::Binding::BufferRange types;
  ImageRef textures;  ///< layers of the blades' images; null: no surface of the world has any
  gpu::Binding::BufferRange colliders;
  bool has_colliders = false;  ///< near any of the patches
};

/// Blades of a view's patches, the drawn ones counted.
struct SortedBlades {
  BufferRef blades;    ///< patch row · 256 + index in the patch, sorted by key
  BufferRef bins;      ///< 257 words: exclusive prefix sum over the keys
  BufferRef draws;     ///< shaders::GrassDraws
  BufferRef casting;   ///< shaders::GrassCasting, without blades
  BufferRef dispatch;  ///< shaders::GrassDispatch, without masters
};

/// Masters that a frame simulates.
struct MasterList {
  BufferRef masters;   ///< shaders::GrassMaster
  BufferRef dispatch;  ///< shaders::GrassDispatch
  BufferRef stamps;    ///< GrassStore::stamps after the frame
};

/// Everything that the draws of blades read.
struct DrawnBlades {
  BufferRef poses;    ///< shaders::GrassPose, of the live blades in sorted order
  BufferRef casting;  ///< shaders::GrassCasting
  BufferRef casters;  ///< its blades: places among the poses, and flags
  BufferRef draws;    ///< shaders::GrassDraws
  BufferRef knots;    ///< GrassStore::knots
  BufferRef indices;  ///< of all draw classes
};

/// The grass of one view of one frame, for casters, visualizers and picking. On the board as std::shared_ptr from
/// PassPhase::announce on; empty until add_grass_passes() sets it as a whole.
struct GrassFrame {
  StoredPatches stored;
  shaders::GrassLod lod;
  shaders::GrassSteps steps;
  SortedBlades sorted;
  BufferRef dispatch;  ///< MasterList::dispatch
  DrawnBlades drawn;
};

}  // namespace gloam
