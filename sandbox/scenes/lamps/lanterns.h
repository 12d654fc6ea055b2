// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows many lights: a paved way between two arcades by night, with 256 coloured point and spot lights: lanterns in
/// the arches, candles at the columns, garlands across the way, washers at the walls. Cameras "main" and "steps".
void build_lanterns_scene(World& world, SceneInfo& info);

}  // namespace gloam
