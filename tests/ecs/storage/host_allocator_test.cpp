// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <new>
#include <random>
#include <utility>
#include <vector>

#include "engine/core/cpu_allocator.h"
#include "engine/ecs/view.h"
#include "tests/ecs/components.h"

namespace gloam::test {
namespace {

/// Counts what lives. Its memory is full of garbage, because a host's need not be zero.
class CountingAllocator final : public CpuAllocator {
 public:
  void* allocate(std::size_t bytes, std::size_t alignment) override {
    if (live_bytes() + bytes > budget) return nullptr;
    void* memory = ::operator new(bytes, std::align_val_t(alignment));
    std::memset(memory, 0xA5, bytes);
    live[memory] = {bytes, alignment};
    return memory;
  }
  void free(void* memory, std::size_t bytes, std::size_t alignment) noexcept override {
    const auto found = live.find(memory);
    EXPECT_TRUE(found != live.end() && found->second == std::pair(bytes, alignment));
    if (found != live.end()) live.erase(found);
    ::operator delete(memory, std::align_val_t(alignment));
  }
  [[nodiscard]] std::size_t live_bytes() const {
    std::size_t sum = 0;
    for (const auto& [memory, block] : live) sum += block.first;
    return sum;
  }

  std::map<void*, std::pair<std::size_t, std::size_t>> live;
  std::size_t budget = ~std::size_t{0} / 2;
};

/// Entities come, change and go, in many archetypes and beyond their first rows.
std::vector<float> play(TestWorld& world) {
  std::mt19937 random(7);
  std::vector<Entity> entities;
  for (int step = 0; step < 6000; ++step) {
    const std::uint32_t what = random() % 8;
    if (what < 4 || entities.empty()) {
      entities.push_back(world.create(Position{static_cast<float>(step), 1, 2}));
    } else {
      const Entity e = entities[random() % entities.size()];
      if (!world.alive(e)) continue;
      if (what == 4) world.destroy(e);
      if (what == 5 && !world.has<Health>(e)) world.add(e, Health{step});
      if (what == 6) world.get<Position>(e).y += 1.0f;
      if (what == 7 && world.has<Health>(e)) world.remove<Health>(e);
    }
  }
  std::vector<float> seen;
  for (const Entity e : entities)
    if (world.alive(e)) {
      seen.push_back(world.get<Position>(e).x + world.get<Position>(e).y);
      seen.push_back(world.has<Health>(e) ? static_cast<float>(world.get<Health>(e).value) : -1.0f);
    }
  return seen;
}

TEST(HostAllocator, gives_all_memory_of_components_and_gets_it_back) {
  CountingAllocator allocator;
  TestWorld of_system;
  const std::vector<float> expected = play(of_system);
  std::size_t after_two = 0;
  for (int lifetime = 1; lifetime <= 20; ++lifetime) {
    {
      TestWorld world({.max_rows_per_archetype = 8192, .max_entities = 8192, .allocator = &allocator});
      EXPECT_EQ(play(world), expected);
      EXPECT_GT(allocator.live_bytes(), std::size_t{100'000});
      EXPECT_LT(allocator.live_bytes(), std::size_t{4'000'000}) << "limits bound it";
      if (lifetime == 2) after_two = allocator.live_bytes();
      if (lifetime == 20) {
        EXPECT_EQ(allocator.live_bytes(), after_two);
      }
    }
    EXPECT_TRUE(allocator.live.empty());
  }
}

TEST(HostAllocator, that_has_no_memory_throws_bad_alloc_and_leaks_nothing) {
  CountingAllocator allocator;
  {
    TestWorld world({.max_rows_per_archetype = 1u << 20, .max_entities = 8192, .allocator = &allocator});
    world.create(Position{1, 2, 3});
    allocator.budget = allocator.live_bytes() + 4096;
    EXPECT_THROW(
        {
          for (int i = 0; i < 5000; ++i) world.create(Position{1, 2, 3});
        },
        std::bad_alloc);
  }
  EXPECT_TRUE(allocator.live.empty());
  allocator.budget = 10;
  EXPECT_THROW(TestWorld world({.allocator = &allocator}), std::bad_alloc);
}

}  // namespace
}  // namespace gloam::test
