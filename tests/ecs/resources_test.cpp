// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/resources.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

struct Clock {
  double seconds = 0;
};
/// Movable, not assignable.
struct Device {
  explicit Device(int n) : number(n) {}
  Device(Device&&) noexcept = default;
  const int number;
};
template <int N>
struct Notes {
  explicit Notes(std::vector<int>* list) : list_(list) {}
  Notes(Notes&& other) noexcept : list_(std::exchange(other.list_, nullptr)) {}
  ~Notes() {
    if (list_ != nullptr) list_->push_back(N);
  }
  std::vector<int>* list_;
};

TEST(Resources, a_resource_keeps_its_address_when_it_is_set_again) {
  World world;
  Clock& clock = world.set_resource<Clock>({1});
  EXPECT_EQ(&world.set_resource<Clock>({2}), &clock);
  EXPECT_EQ(clock.seconds, 2);
  EXPECT_EQ(&world.resource<Clock>(), &clock);
  EXPECT_EQ(std::as_const(world).try_resource<Clock>(), &clock);
}

TEST(Resources, any_movable_type_will_do) {
  World world;
  world.set_resource(std::make_unique<std::string>("a"));
  EXPECT_EQ(*world.resource<std::unique_ptr<std::string>>(), "a");
  const Device& device = world.set_resource(Device(1));
  world.set_resource(Device(2));
  EXPECT_EQ(device.number, 2);
}

TEST(Resources, a_removed_resource_is_absent) {
  World world;
  EXPECT_EQ(world.try_resource<Clock>(), nullptr);
  world.remove_resource<Clock>();
  world.set_resource(Clock{1});
  world.remove_resource<Clock>();
  EXPECT_EQ(world.try_resource<Clock>(), nullptr);
  EXPECT_ASSERT((void)world.resource<Clock>(), "no resource gloam::test::");
  EXPECT_ASSERT((void)std::as_const(world).resource<Clock>(), "no resource");
  world.set_resource(Clock{3});
  EXPECT_EQ(world.resource<Clock>().seconds, 3);
}

TEST(Resources, end_in_reverse_order_of_their_first_set) {
  std::vector<int> ended;
  {
    World world;
    world.set_resource(Notes<1>(&ended));
    world.set_resource(Notes<2>(&ended));
    world.set_resource(Notes<3>(&ended));
  }
  EXPECT_EQ(ended, (std::vector{3, 2, 1}));
}

TEST(Resources, each_view_has_its_own) {
  World world;
  const ViewId main{0};
  const ViewId mirror{900};
  world.set_view_resource(main, Clock{1});
  const Clock& clock = world.set_view_resource(mirror, Clock{2});
  world.set_resource(Clock{3});
  EXPECT_EQ(world.view_resource<Clock>(main).seconds, 1);
  EXPECT_EQ(std::as_const(world).view_resource<Clock>(mirror).seconds, 2);
  EXPECT_EQ(world.resource<Clock>().seconds, 3);
  for (std::uint32_t i = 1; i < 100; ++i) world.set_view_resource(ViewId{i}, Clock{});
  EXPECT_EQ(&world.view_resource<Clock>(mirror), &clock) << "other views do not move it";

  double sum = 0.0;
  world.each_view_resource<Clock>([&](Clock& each) { sum += each.seconds++; });
  EXPECT_EQ(sum, 3);
  EXPECT_EQ(world.view_resource<Clock>(mirror).seconds, 3);

  world.remove_view(mirror);
  EXPECT_EQ(world.try_view_resource<Clock>(mirror), nullptr);
  EXPECT_EQ(std::as_const(world).try_view_resource<Clock>(ViewId{1000}), nullptr);
  EXPECT_NE(world.try_view_resource<Clock>(main), nullptr);
  EXPECT_ASSERT((void)world.view_resource<Clock>(mirror), "no resource");
}

}  // namespace
}  // namespace gloam::test
