// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "modules/grass/frame.h"
#include "modules/grass/growth/entities.h"
#include "modules/grass/lod/store.h"

namespace gloam {

/// State of the module that lives over frames and is no history resource.
struct GrassWorlds {
  GrassStoreStates stores;
  std::map<std::uint64_t, GrassBladeRows> rows;  ///< by world
};

/// The module's number for a world; a resource of the world.
struct GrassWorld {
  std::uint64_t number = 0;
};

/// PassPhase::announce: puts the view's GrassFrame on the board (as std::shared_ptr) and announces casters.
void announce_grass(FrameBuilder& frame);
/// PassPhase::geometry: level of detail, simulation and drawing.
void add_grass_passes(FrameBuilder& frame, GrassWorlds& worlds);
/// Pipelines of all passes with these knobs.
void list_grass_pipelines(const GrassKnobs& knobs, bool threads_in_turn, PipelineList& list);

}  // namespace gloam
