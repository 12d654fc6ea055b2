// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows the largest number of lights that a frame takes: a garden of standing stones and glass on hills by night, with
/// 1024 point and spot lights that reach 1 to 5 m (640 lanterns, 256 lights at the stones' feet, 128 fireflies) and a
/// faint moon. Cameras "main", "edge", "path" and "stones".
void build_many_lights_scene(World& world, SceneInfo& info);

/// Removes the Light component from point and spot lights until `count` of them are left. The kept ones are spread
/// evenly over the lights in order of entity index.
void thin_out_lights(World& world, std::size_t count);

}  // namespace gloam
