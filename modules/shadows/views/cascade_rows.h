// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "modules/lights/outputs.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

/// Appends the cascades of a view's directional lights to the rows of its local ones, GLOAM_MAX_CASCADES a light and
/// those of one light at least, and says in the block where they begin. lights: by index of ShadowBlock::directional.
void append_cascade_rows(std::span<const DirectionalLook> lights, shaders::ShadowBlock& block,
                         std::vector<shaders::ShadowRow>& rows);

}  // namespace gloam
