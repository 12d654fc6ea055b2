// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A host that uses the entities alone: moves points by their velocity and compares each with its closed form.
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"

namespace {

struct Position {
  double x = 0.0;
};
struct Velocity {
  double x = 0.0;
};
struct Number {
  std::uint32_t value = 0;
};

}  // namespace

int main() {
  constexpr std::uint32_t kCount = 10'000;
  constexpr int kSteps = 8;
  gloam::World world;
  world.register_component<Position>();
  world.register_component<Velocity>();
  world.register_component<Number>();
  for (std::uint32_t i = 0; i < kCount; ++i) {
    if (i % 3 == 0)
      world.create(Position{double(i)}, Number{i});
    else
      world.create(Position{double(i)}, Velocity{0.25 * i}, Number{i});
  }
  const auto executor = gloam::make_serial_executor();
  for (int step = 0; step < kSteps; ++step) {
    world.view<Position, const Velocity>().parallel_each(
        *executor, 256, [](Position& position, const Velocity& velocity) { position.x += velocity.x; });
  }
  std::uint32_t right = 0;
  world.view<const Position, const Number>().each([&](const Position& position, const Number& number) {
    const double expected = number.value * (number.value % 3 == 0 ? 1.0 : 1.0 + 0.25 * kSteps);
    right += position.x == expected ? 1 : 0;
  });
  if (right == kCount) return 0;
  std::fprintf(stderr, "host_ecs: %u of %u points are in place\n", right, kCount);
  return 1;
}
