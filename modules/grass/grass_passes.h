// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/once_log.h"
#include "engine/frame/transfers/staging.h"
#include "modules/grass/field/entities.h"
#include "modules/grass/frame.h"
#include "modules/grass/lod/store.h"

namespace gloam {

/// State of the module that lives over frames and is no history resource.
struct GrassWorlds {
  GrassStoreStates stores;
  OnceLog notes_log;         ///< for GrassField::notes and BladeTextures::faults
  Staging staging{"grass"};  ///< of the blades' images
};

/// The rows of a world's blades; a resource of the world.
struct GrassWorld {
  std::shared_ptr<GrassBladeRows> rows = std::make_shared<GrassBladeRows>();
};

/// PassPhase::announce: puts an empty GrassFrame on the board (as std::shared_ptr) and announces casters.
void announce_grass(FrameBuilder& frame);
/// PassPhase::geometry: level of detail, simulation and drawing. Sets the GrassFrame.
void add_grass_passes(FrameBuilder& frame, GrassWorlds& worlds);
/// Pipelines of all passes with these knobs. textured: blades have images.
void list_grass_pipelines(const GrassKnobs& knobs, bool threads_in_turn, bool textured, PipelineList& list);

}  // namespace gloam
