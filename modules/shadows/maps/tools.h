// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// The parts of the module that ShadowMapDrawer and OverlayMaps use.
struct ShadowMapTools {
  ShadowStates& states;
  ShadowKnobs knobs;
  shaders::ShadowBlock block;  ///< constants of the frame's standard maps
};

}  // namespace gloam
