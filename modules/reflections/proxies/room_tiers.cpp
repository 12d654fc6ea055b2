// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/room_tiers.h"

#include <algorithm>

#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/culling/tiles.h"

namespace gloam {
namespace {

ReflectionKnobs with_at_most(ReflectionKnobs knobs, bool screen_space, bool proxies) {
  knobs.screen_space = knobs.screen_space && screen_space;
  knobs.proxies = knobs.proxies && proxies;
  return knobs;
}

}  // namespace

RoomTiersInUse room_tiers_in_use(const World& world) {
  RoomTiersInUse used = 0;
  for (const PlacedRoom& room : world.resource<ProxySet>().rooms)
    used |= 1u << (2u * (room.screen_space ? 1u : 0u) + (room.proxies ? 1u : 0u));
  return used;
}

ReflectionKnobs in_room(ReflectionKnobs knobs, const World& world, ViewId view) {
  const PlacedRoom* room = smallest_room(world.resource<ProxySet>().rooms, world.view_resource<ProxyTiles>(view).rooms);
  return room == nullptr ? knobs : with_at_most(knobs, room->screen_space, room->proxies);
}

std::vector<ReflectionKnobs> in_all_rooms(const ReflectionKnobs& knobs, RoomTiersInUse used) {
  std::vector<ReflectionKnobs> all = {knobs};
  for (std::uint32_t kind = 0; kind < 4; ++kind) {
    if ((used >> kind & 1u) == 0) continue;
    const ReflectionKnobs next = with_at_most(knobs, kind >= 2, kind % 2 == 1);
    if (std::ranges::none_of(all, [&](const ReflectionKnobs& other) {
          return other.screen_space == next.screen_space && other.proxies == next.proxies;
        }))
      all.push_back(next);
  }
  return all;
}

}  // namespace gloam
