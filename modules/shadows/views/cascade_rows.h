// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "modules/lights/outputs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// Appends the CascadeRows of the view's directional lights to `rows`, which holds the rows of its local lights:
/// GLOAM_MAX_CASCADES rows per light. Without lights, appends the rows of one light without cascades, so that shaders
/// always find a row. Sets block.cascade_row to the index of the first appended row. lights: in the order of
/// ShadowBlock::directional.
void append_cascade_rows(std::span<const DirectionalLook> lights, shaders::ShadowBlock& block,
                         std::vector<shaders::ShadowRow>& rows);

}  // namespace gloam
