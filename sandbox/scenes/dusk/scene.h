// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows all effects together: the edge of an old town after rain and sunset. A street of wet setts along −Z, with
/// puddles, shops and lit windows on its left and market stalls on its right; beyond the stalls a lawn with a path,
/// trees and a bandstand. A fire burns in a basket, steam rises from a pot, fog lies over the lawn, and two people
/// walk.
///
/// Cameras: "square" (the street), "stall" (a stall through a lens), "lawn" (the bandstand over the grass), "walk" (a
/// round through street and lawn, kDuskWalk_s).
void build_dusk_scene(World& world, SceneInfo& info);

inline constexpr double kDuskWalk_s = 30.0;  ///< duration of the clip of the camera "walk"

}  // namespace gloam
