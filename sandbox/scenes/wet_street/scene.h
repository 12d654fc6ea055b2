// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr int kWetStreetProxies = 50;  ///< IbrProxy entities in builtin:wet_street, one of them a fire
inline constexpr int kWetStreetRooms = 4;
inline constexpr int kWetStreetLamps = 60;    ///< point and spot lights
inline constexpr int kWetStreetCasting = 12;  ///< lamps that cast shadows

/// Shows reflections on wet ground: a street at dusk after rain, along −Z from z = 9 to −50, between facades with lit
/// windows (x = ±5.5). A gatehouse at z = −24…−29 divides it; an alley leads to the right at z = −18…−22; above the
/// shops before the alley lies a terrace at y = 3.6. Puddles differ in roughness. Proxies stand for the facades and for
/// a fire in a barrel, in the rooms "near", "far", "alley" and "terrace"; each room has a cube probe, and one is
/// global.
///
/// Cameras: "street" (eye height, puddles before facades and fire), "grazing" (0.3 m above the ground), "down" (steeply
/// onto a puddle of the alley), "terrace" (wet floor above the street), "shop" (objects that stand in a puddle before a
/// lit window), "still" (a puddle of least roughness before the clock tower).
void build_wet_street_scene(World& world, SceneInfo& info);

}  // namespace gloam
