// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/access.h"

#include <gtest/gtest.h>

#include "engine/schedule/system.h"

namespace gloam {
namespace {

struct Position {
  float x = 0;
};
struct Velocity {
  float x = 0;
};
struct Frozen {};
struct Clock {};
struct Bins {};

void reads_position(View<const Position>) {}
void writes_position(View<Position, const Velocity>) {}
void may_write_position(View<const Velocity, Maybe<Position>>) {}
void filters_by_position(View<const Velocity, With<Position>, Without<Frozen>>) {}
void reads_clock(Resource<const Clock>) {}
void may_write_clock(const OptionalResource<Clock>&) {}
void writes_bins_of_view(ViewResource<Bins>) {}
void writes_bins_of_world(Resource<Bins>) {}
void reads_and_writes(View<const Position>, View<Position>) {}
void takes_the_rest(JobExecutor&, Commands&, ViewId) {}

template <class A, class B>
bool conflicting(A* a, B* b) {
  EXPECT_EQ(conflict(access_of(a), access_of(b)), conflict(access_of(b), access_of(a)));
  return conflict(access_of(a), access_of(b));
}

TEST(access, of_a_signature_tells_reads_from_writes) {
  const SystemAccess access = access_of(&writes_position);
  ASSERT_EQ(access.accesses.size(), 2u);
  EXPECT_TRUE(access.find(AccessKind::component, type_key<Position>())->write);
  EXPECT_FALSE(access.find(AccessKind::component, type_key<Velocity>())->write);
  EXPECT_EQ(access.find(AccessKind::resource, type_key<Position>()), nullptr);
}

TEST(access, to_one_thing_twice_is_the_wider_one) {
  const SystemAccess access = access_of(&reads_and_writes);
  ASSERT_EQ(access.accesses.size(), 1u);
  EXPECT_TRUE(access.accesses.front().write);
}

TEST(access, knows_commands_and_what_belongs_to_a_view) {
  EXPECT_TRUE(access_of(&takes_the_rest).commands);
  EXPECT_TRUE(access_of(&takes_the_rest).per_view);
  EXPECT_TRUE(access_of(&writes_bins_of_view).per_view);
  EXPECT_FALSE(access_of(&writes_bins_of_world).per_view);
  EXPECT_TRUE(access_of(&takes_the_rest).accesses.empty());
}

TEST(access, conflicts_when_one_of_two_writes) {
  EXPECT_TRUE(conflicting(&reads_position, &writes_position));
  EXPECT_TRUE(conflicting(&writes_position, &writes_position));
  EXPECT_TRUE(conflicting(&reads_position, &may_write_position));
  EXPECT_TRUE(conflicting(&reads_clock, &may_write_clock));
  EXPECT_FALSE(conflicting(&reads_position, &reads_position));
  EXPECT_FALSE(conflicting(&reads_clock, &writes_position));
}

TEST(access, does_not_conflict_over_filters_or_between_world_and_view) {
  EXPECT_FALSE(conflicting(&filters_by_position, &writes_position));
  EXPECT_FALSE(conflicting(&writes_bins_of_view, &writes_bins_of_world));
}

}  // namespace
}  // namespace gloam
