// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/room_tiers.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "modules/reflections/culling/placed.h"

namespace gloam {
namespace {

using Tiers = std::vector<std::pair<bool, bool>>;

Tiers tiers_of(const ReflectionKnobs& knobs, RoomTiersInUse used) {
  Tiers tiers;
  for (const ReflectionKnobs& k : in_all_rooms(knobs, used)) tiers.emplace_back(k.screen_space, k.proxies);
  return tiers;
}

RoomTiersInUse used_by(const Tiers& rooms) {
  World world;
  ProxySet set;
  for (const auto& [screen_space, proxies] : rooms) {
    set.rooms.emplace_back().screen_space = screen_space;
    set.rooms.back().proxies = proxies;
  }
  world.set_resource(set);
  return room_tiers_in_use(world);
}

TEST(RoomTiers, of_a_world_are_each_listed_once) {
  ReflectionKnobs all;
  EXPECT_EQ(tiers_of(all, used_by({})), (Tiers{{true, true}}));
  EXPECT_EQ(tiers_of(all, used_by({{true, true}, {true, true}})), (Tiers{{true, true}}));
  EXPECT_EQ(tiers_of(all, used_by({{false, true}, {true, false}, {false, false}, {false, true}})),
            (Tiers{{true, true}, {false, false}, {false, true}, {true, false}}));
}

TEST(RoomTiers, are_at_most_those_of_the_knob) {
  ReflectionKnobs knobs;
  knobs.screen_space = false;
  EXPECT_EQ(tiers_of(knobs, used_by({{true, true}, {true, false}})), (Tiers{{false, true}, {false, false}}));
  knobs.proxies = false;
  EXPECT_EQ(tiers_of(knobs, used_by({{true, true}, {true, false}, {false, true}})), (Tiers{{false, false}}));
}

}  // namespace
}  // namespace gloam
