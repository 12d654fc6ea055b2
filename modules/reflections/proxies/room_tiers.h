// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/reflections/knobs.h"

namespace gloam {

/// Bit 2 · screen_space + proxies of each kind of room in a world.
using RoomTiersInUse = std::uint32_t;
[[nodiscard]] RoomTiersInUse room_tiers_in_use(const World& world);

/// The knobs without the tiers that the camera's smallest room leaves out (IbrRoom::tiers). For views whose ProxyTiles
/// are up to date.
[[nodiscard]] ReflectionKnobs in_room(ReflectionKnobs knobs, const World& world, ViewId view);

/// The knobs that views of a world may have, in its rooms and outside: each once, `knobs` first. So pipelines are known
/// before the camera enters a room.
[[nodiscard]] std::vector<ReflectionKnobs> in_all_rooms(const ReflectionKnobs& knobs, RoomTiersInUse used);

}  // namespace gloam
