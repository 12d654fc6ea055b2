// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include "engine/render/governor/budget_control.h"
#include "tests/render/governor/budget_knobs.h"
#include "tests/render/governor/machine.h"

// Counts the allocations of this program. The operators are those of the whole program, so this file has one of its
// own.

namespace {
std::atomic<std::size_t> g_allocations = 0;
}

void* operator new(std::size_t bytes) {
  ++g_allocations;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++g_allocations;
  return std::malloc(bytes > 0 ? bytes : 1);
}
// Not inline: GCC takes a free() without a malloc() beside it for a fault.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace gloam {
namespace {

TEST(GovernorAllocationTest, frames_and_budgets_allocate_nothing) {
  const std::vector<GovernorPoint> front = test::geometric_front(24, 5.0, 1.1);
  const std::size_t at_start = g_allocations;
  Governor governor(front, 20.0);
  EXPECT_GT(g_allocations, at_start) << "allocations are counted";
  test::NoiseSource noise(1, test::Noise::gaussian, 0.15);
  std::size_t changes = 0;
  const std::size_t before = g_allocations;
  for (std::size_t frame = 0; frame < 20000; ++frame) {
    if (frame % 1700 == 0) governor.set_budget(frame % 3400 == 0 ? 15.0 : 25.0);
    const double load = frame / 500 % 2 == 0 ? 1.0 : 1.8;
    const double ms = front[governor.point()].ms * (governor.point() > 9 ? 1.3 : 1.0) * load * noise.next();
    changes += governor.add({ms, true, frame / 4000}).changed() ? 1 : 0;
  }
  const std::size_t after = g_allocations;
  EXPECT_EQ(after, before);
  EXPECT_GT(changes, 50U);
}

/// Two copies of the registry, as the renderer has them: the values that were set, and those of frames.
TEST(GovernorAllocationTest, a_change_of_point_allocates_nothing) {
  KnobRegistry knobs = test::budget_knobs();
  KnobRegistry drawn = knobs;
  auto control = BudgetControl::create({.ms = 25.0, .front = test::three_points()}, knobs);
  ASSERT_TRUE(control.ok());
  control->apply(knobs);
  std::size_t changes = 0;
  const std::size_t before = g_allocations;
  for (std::size_t frame = 0; frame < 2000; ++frame) {
    drawn.take_values(knobs);
    const FrameTime time = {.ms = frame / 200 % 2 == 0 ? 60.0 : 5.0, .view = frame / 200};
    changes += control->add(time, drawn.version(), knobs).changed() ? 1 : 0;
  }
  const std::size_t after = g_allocations;
  EXPECT_EQ(after, before);
  EXPECT_GT(changes, 8U);
}

}  // namespace
}  // namespace gloam
