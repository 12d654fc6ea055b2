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
  BufferRef stamps;  ///< uint: step that a master has reached, GrassFrame::slot_masters per slot
  BufferRef knots;   ///< vec4, 16 per master
  BufferRef previous_knots;
};

/// The grass of one view of one frame, as its passes hand it on.
struct GrassFrame {
  GrassKnobs knobs;
  std::vector<ResidentPatch> patches;  ///< of the patch rows, nearest first
  std::uint32_t group_masters = 0;     ///< masters of one workgroup of the simulation
  std::uint32_t slot_masters = 0;      ///< masters for which a slot has room
  shaders::GrassLod lod;
  shaders::GrassSteps steps;
  gpu::Binding::BufferRange lod_range;
  gpu::Binding::BufferRange patch_rows;
  gpu::Binding::BufferRange types;
  gpu::Binding::BufferRange colliders;
  bool has_colliders = false;  ///< near any of the patches
  GrassStore store;
  BufferRef blades;    ///< patch row · 256 + index in the patch, sorted by key
  BufferRef bins;      ///< 257 words: exclusive prefix sum over the keys
  BufferRef draws;     ///< shaders::GrassDraws
  BufferRef dispatch;  ///< shaders::GrassDispatch
  BufferRef masters;   ///< shaders::GrassMaster
  BufferRef poses;     ///< shaders::GrassPose, of the live blades in sorted order
  BufferRef indices;   ///< of all draw classes
};

}  // namespace gloam
