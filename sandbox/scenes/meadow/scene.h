// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr int kMeadowBlades = 100'000;  ///< density × area of the GrassSurface
inline constexpr int kMeadowBalls = 4;
inline constexpr int kMeadowLanterns = 5;
inline constexpr double kMeadowRound_s = 60.0;  ///< all animations repeat together

/// Shows grass that bends: a field of 24 × 24 m by night with a path along z, wind, balls that roll, someone who walks
/// a loop, two crates, lanterns on poles and a moon.
///
/// Cameras: "near" (eye height 1.2 m, the walker and balls), "far" (from a hill at the edge), "ground" (0.35 m above
/// the ground, among blades), "lanterns" (grass under a lantern), "above" (60° down), "walk" (moves through the field
/// at 1.4 m/s).
void build_meadow_scene(World& world, SceneInfo& info);

/// The same by day: a sun in place of the moon and the lanterns.
void build_meadow_day_scene(World& world, SceneInfo& info);

}  // namespace gloam
