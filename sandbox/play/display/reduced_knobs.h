// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// The knobs of a view that a software device draws at a share of the window's width and height, 0.25…1. Below one
/// half, shadow maps have fewer texels a pixel, and near blockers are looked for in fewer directions: the picture is
/// enlarged, which blurs more than these do, and of the time of small pictures most goes into shadows. Values that are
/// not the defaults stay.
[[nodiscard]] std::vector<KnobOverride> knobs_at_scale(const KnobRegistry& knobs, double scale);

}  // namespace gloam
