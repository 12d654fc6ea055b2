// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr int kSmokeEmitters = 5;

/// Lit particles in a courtyard at night: a column of smoke between a warm lamp on its left and a cold one on its
/// right, a fire in a bowl on wet ground with its smoke, dust in the beam of a spot, and fog over the ground.
/// Cameras: "near" (the column between the lamps), "far" (the whole courtyard), "fire" (the fire and its mirror image),
/// "beam" (the dust), "inside" (within the column), "away" (no emitter in view).
void build_smoke_scene(World& world, SceneInfo& info);

}  // namespace gloam
