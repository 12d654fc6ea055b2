// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/room_tiers.h"

#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/culling/tiles.h"

namespace gloam {

ReflectionKnobs in_room(ReflectionKnobs knobs, const World& world, ViewId view) {
  const PlacedRoom* room = smallest_room(world.resource<ProxySet>().rooms, world.view_resource<ProxyTiles>(view).rooms);
  if (room == nullptr) return knobs;
  knobs.screen_space = knobs.screen_space && room->screen_space;
  knobs.proxies = knobs.proxies && room->proxies;
  return knobs;
}

}  // namespace gloam
