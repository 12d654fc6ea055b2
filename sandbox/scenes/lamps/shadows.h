// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows penumbrae that widen with the distance from the caster: columns, a grille, a table, a sheet without thickness
/// and a ball, lit by a wide lamp, a spot and a moon. Cameras "main" and "close".
void build_shadows_scene(World& world, SceneInfo& info);

}  // namespace gloam
