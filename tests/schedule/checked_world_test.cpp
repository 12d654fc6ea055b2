// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/checked_world.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "engine/schedule/schedule.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

struct Position {
  int x = 0;
};
struct Velocity {
  int x = 0;
};
struct Counter {
  int value = 0;
};
/// A resource through which test systems access the world without declaring it.
struct Smuggler {
  std::function<void(World&)> act;
  World* world = nullptr;
};

void smuggle(View<const Position> view, Resource<Smuggler> smuggler) {
  view.each([](const Position&) {});
  if (smuggler->act) smuggler->act(*smuggler->world);
}
void smuggle_in_jobs(View<const Position> view, Resource<Smuggler> smuggler, JobExecutor& jobs) {
  view.parallel_each(jobs, 1, [&](const Position&) {
    if (smuggler->act) smuggler->act(*smuggler->world);
  });
}
void honest(View<Position, const Velocity> view, Resource<Counter> counter, OptionalResource<const int> nothing,
            JobExecutor& jobs, Commands& commands) {
  view.parallel_each(jobs, 10, [](Position& p, const Velocity& v) { p.x += v.x; });
  commands.create(Position{++counter->value});
  EXPECT_FALSE(nothing);
}

class CheckedWorldTest : public ::testing::Test {
 protected:
  CheckedWorldTest() {
    world_.register_component<Position>("position");
    world_.register_component<Velocity>("velocity");
    for (int i = 0; i < 100; ++i) entity_ = world_.create(Position{i}, Velocity{1});
    world_.set_resource(Counter{});
    world_.set_resource(Smuggler{{}, &world_});
    schedule_.set_checked(true);
  }
  void run(std::function<void(World&)> act) {
    world_.resource<Smuggler>().act = std::move(act);
    schedule_.run(Stage::world, world_, *executor_);
  }

  World world_;
  Entity entity_;
  Schedule schedule_;
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
};

TEST_F(CheckedWorldTest, lets_declared_accesses_pass) {
  schedule_.add_system("honest", "m", Stage::world, &honest);
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    const auto pool = make_pool_executor(threads);
    for (int i = 0; i < 20; ++i) schedule_.run(Stage::world, world_, *pool);
  }
  EXPECT_EQ(world_.entity_count(), 160u);
  EXPECT_EQ(world_.get<Position>(entity_).x, 99 + 60);
}

TEST_F(CheckedWorldTest, traps_undeclared_components_by_the_name_of_the_system) {
  schedule_.add_system("sly", "thieves", Stage::world, &smuggle);
  EXPECT_ASSERT(run([&](World& world) { (void)std::as_const(world).get<Velocity>(entity_); }),
                "system \"sly\" (module \"thieves\") reads component velocity, which its signature does not declare");
  EXPECT_ASSERT(run([&](World& world) { world.view<Velocity>().each([](Velocity&) {}); }),
                "writes component velocity, which its signature does not declare");
  EXPECT_ASSERT(run([&](World& world) { (void)world.get<Position>(entity_); }),
                "writes component position, which its signature declares as read only");
}

TEST_F(CheckedWorldTest, traps_undeclared_resources) {
  schedule_.add_system("sly", "thieves", Stage::world, &smuggle);
  EXPECT_ASSERT(run([](World& world) { (void)std::as_const(world).resource<Counter>(); }), "reads resource");
  EXPECT_ASSERT(run([](World& world) { world.set_resource(Counter{}); }), "writes resource");
}

TEST_F(CheckedWorldTest, traps_structural_changes) {
  schedule_.add_system("sly", "thieves", Stage::world, &smuggle);
  EXPECT_ASSERT(run([](World& world) { world.create(Position{}); }), "must record that in Commands");
}

TEST_F(CheckedWorldTest, traps_accesses_in_jobs_of_a_system) {
  schedule_.add_system("sly", "thieves", Stage::world, &smuggle_in_jobs);
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    executor_ = make_pool_executor(threads);
    EXPECT_ASSERT(run([&](World& world) { (void)std::as_const(world).get<Velocity>(entity_); }),
                  "system \"sly\" (module \"thieves\") reads component velocity");
  }
}

TEST_F(CheckedWorldTest, checks_only_when_asked_and_only_inside_systems) {
  schedule_.add_system("sly", "thieves", Stage::world, &smuggle);
  const auto act = [&](World& world) { (void)world.get<Velocity>(entity_); };
  EXPECT_ASSERT(run(act), "velocity");
  act(world_);
  schedule_.set_checked(false);
  run(act);
  CheckedWorld checker(world_);
  act(world_);
}

TEST_F(CheckedWorldTest, wraps_batches_and_graphs_too) {
  System system;
  system.name = "jobs";
  CheckedWorld checker(world_);
  CheckedExecutor checked(*executor_, checker, system);
  const std::vector<std::function<void()>> jobs(3, [&] { (void)std::as_const(world_).get<Position>(entity_); });
  std::vector<JobNode> nodes(1);
  nodes[0].work = jobs[0];
  EXPECT_ASSERT(checked.run(jobs), "system \"jobs\"");
  EXPECT_ASSERT(checked.run_graph(nodes), "system \"jobs\"");
  EXPECT_EQ(checked.worker_count(), 1u);
}

}  // namespace
}  // namespace gloam
