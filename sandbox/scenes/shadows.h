// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

/// Shows shadows that widen with the distance to what casts them: columns, a grille, a table, a sheet of no thickness
/// and a ball under a wide lamp, a spot and a moon. Cameras "main" and "close".
void build_shadows_scene(World& world, SceneInfo& info);

}  // namespace gloam
