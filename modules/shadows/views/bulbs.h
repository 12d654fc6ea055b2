// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {

/// Greatest distance of a bulb from the emitter's centre, in radii of the emitter.
inline constexpr double kBulbDistance = 1.5;
/// Greatest half diagonal of a bulb, in radii of the emitter.
inline constexpr double kBulbReach = 5.0;

/// The light's bulb_radius_m for is_bulb(); −1 for directional lights.
[[nodiscard]] double bulb_radius(const Light& light);

}  // namespace gloam
