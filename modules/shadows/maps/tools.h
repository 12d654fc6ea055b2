// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// What ShadowMapDrawer and OverlayMaps work with.
struct ShadowMapTools {
  ShadowStates& states;
  ShadowKnobs knobs;
  shaders::ShadowBlock block;  ///< of the frame's standard maps
};

}  // namespace gloam
