// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "engine/ecs/world.h"

// Component types for the tests of this folder: columns of 4, 12, 8 and many bytes per row, and tags.
namespace gloam::test {

struct Health {
  int value = 0;
};
struct Position {
  float x = 0, y = 0, z = 0;
};
struct Serial {
  std::uint64_t value = 0;
};
struct Big {
  std::array<std::uint32_t, 21> words{};
};
struct Frozen {};
struct Visible {};

inline void register_all(World& world) {
  world.register_component<Health>("health");
  world.register_component<Position>("position");
  world.register_component<Serial>("serial");
  world.register_component<Big>("big");
  world.register_component<Frozen>("frozen");
  world.register_component<Visible>("visible");
}

struct TestWorld : World {
  explicit TestWorld(const WorldLimits& limits = {}) : World(limits) { register_all(*this); }
};

}  // namespace gloam::test
