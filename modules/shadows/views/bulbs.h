// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/shadows/components.h"

namespace gloam {

/// Radius of a local light's emitter for is_bulb(). Emitters with less are given the distance within which nothing
/// blocks a light: maps hold nothing nearer (near planes), and traced rays end there.
inline constexpr double kLeastEmitter_m = 0.05;
/// Greatest distance of a bulb from the emitter's centre, in radii of the emitter.
inline constexpr double kBulbDistance = 1.5;
/// Greatest half diagonal of a bulb, in radii of the emitter.
inline constexpr double kBulbReach = 5.0;

}  // namespace gloam
