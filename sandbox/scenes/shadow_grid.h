// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "engine/ecs/world.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

inline constexpr std::size_t kShadowGridLights = 256;

/// Shows many lights that all cast shadows: lanterns and hooded lamps, half points and half spots, spread evenly over a
/// pergola of pillars, low walls and crates by night; about three reach a point of the ground. Cameras "main", "aisle",
/// "corner", "crates", "over" and "far", in the order of a walk.
void build_shadow_grid_scene(World& world, SceneInfo& info);

/// Leaves the scene's first `count` lights, which are spread as evenly as all are, and gives each the range by which
/// about `lights_a_point` of them reach a point of the ground.
void arrange_shadow_grid_lights(World& world, std::size_t count, double lights_a_point);

/// The range in metres by which about `lights_a_point` of `count` evenly spread lights reach a point of the scene's
/// ground.
[[nodiscard]] double shadow_grid_range_m(std::size_t count, double lights_a_point);

/// Poses the scene's moving casters, boards that turn on posts, as at a time; for the frame that is drawn next.
void turn_shadow_grid_boards(World& world, double time_s);

}  // namespace gloam
