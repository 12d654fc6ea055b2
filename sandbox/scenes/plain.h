// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows geometry: a box, a sphere, a column and an arch in four materials on a floor, under one sun. Camera "main".
void build_plain_scene(World& world, SceneInfo& info);

}  // namespace gloam
