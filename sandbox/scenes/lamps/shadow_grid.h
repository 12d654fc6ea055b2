// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr std::size_t kShadowGridLights = 256;

/// Shows many lights that all cast shadows: lanterns (point lights) and hooded lamps (spot lights), half of each,
/// spread evenly over a pergola with pillars, low walls and crates by night. About three lights reach each point on the
/// ground. Cameras "main", "aisle", "corner", "crates", "over" and "far", in the order of a walk.
void build_shadow_grid_scene(World& world, SceneInfo& info);

/// Keeps the scene's first `count` lights, which are spread as evenly as all lights, and removes the others. Sets the
/// range of each so that about `lights_a_point` of them reach each point on the ground, and its intensity so that their
/// sum at a point stays the same.
void arrange_shadow_grid_lights(World& world, std::size_t count, double lights_a_point);

/// The range in metres with which about `lights_a_point` of `count` evenly spread lights reach each point on the
/// ground.
[[nodiscard]] double shadow_grid_range_m(std::size_t count, double lights_a_point);

/// Poses the scene's moving casters (boards that turn on posts) for time_s. Takes effect in the next frame.
void turn_shadow_grid_boards(World& world, double time_s);

}  // namespace gloam
