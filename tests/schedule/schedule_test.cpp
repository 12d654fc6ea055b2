// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/schedule.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/zones.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

struct Position {
  int x = 0;
};
struct Velocity {
  int x = 0;
};
struct Step {
  int length = 1;
};
struct Log {
  std::string text;
};
struct Other {
  int value = 0;
};

void move_system(View<const Velocity, Position> view, Resource<const Step> step) {
  view.each([&](const Velocity& v, Position& p) { p.x += v.x * step->length; });
}
void log_a(Resource<Log> log) { log->text += "a"; }
void log_b(Resource<Log> log) { log->text += "b"; }
void log_c(Resource<Log> log) { log->text += "c"; }
void log_view(ViewResource<Log> log, ViewId view) { log->text += std::to_string(view.value); }
void spawn_one(Commands& commands) { commands.create(Position{1}); }
void spawn_two(Commands& commands) { commands.create(Position{2}); }
void fail(Resource<Other>) { throw std::runtime_error("failed"); }
void fail_too(Resource<const Step>) { throw std::runtime_error("failed too"); }
void behind_the_failure(Resource<const Other>, Resource<Position> ran) { ran->x = 1; }

class ScheduleTest : public ::testing::Test {
 protected:
  ScheduleTest() {
    world_.register_component<Position>("position");
    world_.register_component<Velocity>("velocity");
    world_.set_resource(Step{});
    world_.set_resource(Log{});
    world_.set_resource(Other{});
  }
  void run() { schedule_.run(Stage::world, world_, *executor_); }
  [[nodiscard]] std::string log() { return world_.resource<Log>().text; }

  World world_;
  Schedule schedule_;
  std::unique_ptr<JobExecutor> executor_ = make_pool_executor(2);
};

TEST_F(ScheduleTest, runs_nothing_when_it_is_empty) {
  run();
  schedule_.run_view({1}, world_, *executor_);
  EXPECT_EQ(schedule_.describe(), "");
}

TEST_F(ScheduleTest, hands_a_system_what_its_signature_names) {
  const Entity e = world_.create(Position{10}, Velocity{3});
  world_.resource<Step>().length = 5;
  schedule_.add_system("move", "physics", Stage::world, &move_system);
  run();
  run();
  EXPECT_EQ(world_.get<Position>(e).x, 40);
}

TEST_F(ScheduleTest, runs_conflicting_systems_in_order_of_registration) {
  schedule_.add_system("c", "m", Stage::world, &log_c);
  schedule_.add_system("a", "m", Stage::world, &log_a);
  schedule_.add_system("b", "m", Stage::world, &log_b);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    world_.resource<Log>().text.clear();
    const auto shuffled = make_shuffled_executor(seed);
    schedule_.run(Stage::world, world_, *shuffled);
    ASSERT_EQ(log(), "cab");
  }
}

TEST_F(ScheduleTest, skips_disabled_modules_until_they_are_enabled_again) {
  schedule_.add_system("a", "one", Stage::world, &log_a);
  schedule_.add_system("b", "two", Stage::world, &log_b);
  schedule_.add_system("c", "one", Stage::world, &log_c);
  run();
  schedule_.set_enabled("one", false);
  EXPECT_FALSE(schedule_.is_enabled("one"));
  run();
  schedule_.set_enabled("one", true);
  run();
  EXPECT_EQ(log(), "abcbabc");
}

TEST_F(ScheduleTest, takes_systems_added_after_a_run) {
  schedule_.add_system("a", "m", Stage::world, &log_a);
  run();
  schedule_.add_system("b", "m", Stage::world, &log_b);
  run();
  EXPECT_EQ(log(), "aab");
}

TEST_F(ScheduleTest, runs_the_view_stage_with_the_resources_of_that_view) {
  world_.set_view_resource(ViewId{3}, Log{});
  world_.set_view_resource(ViewId{4}, Log{});
  schedule_.add_system("a", "m", Stage::world | Stage::view, &log_a);
  schedule_.add_system("view", "m", Stage::view, &log_view);
  run();
  schedule_.run_view({3}, world_, *executor_);
  schedule_.run_view({4}, world_, *executor_);
  schedule_.run_view({4}, world_, *executor_);
  EXPECT_EQ(world_.view_resource<Log>({3}).text, "3");
  EXPECT_EQ(world_.view_resource<Log>({4}).text, "44");
  EXPECT_EQ(log(), "aaaa");
}

TEST_F(ScheduleTest, applies_commands_in_order_of_registration_at_the_end_of_the_stage) {
  schedule_.add_system("two", "m", Stage::world, &spawn_two);
  schedule_.add_system("one", "m", Stage::world, &spawn_one);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    World world;
    world.register_component<Position>("position");
    const auto shuffled = make_shuffled_executor(seed);
    schedule_.run(Stage::world, world, *shuffled);
    std::vector<int> values;
    world.view<const Position>().each([&](const Position& p) { values.push_back(p.x); });
    ASSERT_EQ(values, (std::vector<int>{2, 1}));
  }
}

TEST_F(ScheduleTest, rethrows_the_earliest_failure_and_drops_the_commands) {
  world_.set_resource(Position{0});
  schedule_.add_system("spawn", "m", Stage::world, &spawn_one);
  schedule_.add_system("fail", "bad", Stage::world, &fail);
  schedule_.add_system("fail_too", "bad", Stage::world, &fail_too);
  schedule_.add_system("behind", "m", Stage::world, &behind_the_failure);
  std::string message;
  try {
    run();
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "failed");
  EXPECT_EQ(schedule_.failed_system(), "fail");
  EXPECT_EQ(world_.resource<Position>().x, 0);
  EXPECT_EQ(world_.entity_count(), 0u);
  schedule_.set_enabled("bad", false);
  run();
  EXPECT_EQ(world_.resource<Position>().x, 1);
  EXPECT_EQ(world_.entity_count(), 1u);
}

TEST_F(ScheduleTest, records_a_zone_for_each_system) {
  schedule_.add_system("a", "lights", Stage::world, &log_a);
  schedule_.add_system("b", "shadows", Stage::world, &log_b);
  ZoneRecorder zones;
  schedule_.run(Stage::world, world_, *executor_, &zones);
  const std::vector<Zone> taken = zones.take();
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0].name + " " + taken[0].module, "a lights");
  EXPECT_EQ(taken[1].name + " " + taken[1].module, "b shadows");
  EXPECT_LE(taken[0].end_ns, taken[1].begin_ns);
}

TEST_F(ScheduleTest, describes_itself_a_line_a_system) {
  schedule_.add_system("move", "physics", Stage::world, &move_system);
  schedule_.add_system("log", "debug", Stage::world | Stage::view, &log_a).after("move");
  schedule_.add_system("spawn", "grass", Stage::world, &spawn_one);
  schedule_.add_system("view", "debug", Stage::view, &log_view);
  schedule_.set_enabled("grass", false);
  EXPECT_EQ(schedule_.describe(),
            "world move (physics): reads Velocity, Step; writes Position\n"
            "world log (debug): writes Log; waits for move\n"
            "world spawn (grass): records commands; disabled\n"
            "view log (debug): writes Log\n"
            "view view (debug): writes Log\n");
}

TEST_F(ScheduleTest, refuses_a_name_twice_and_after_a_stranger) {
  auto added = schedule_.add_system("a", "m", Stage::world, &log_a);
  EXPECT_ASSERT(schedule_.add_system("a", "m", Stage::world, &log_b), "\"a\" was added already");
  EXPECT_ASSERT(added.after("ghost"), "\"a\" is to run after \"ghost\"");
  schedule_.add_system("b", "m", Stage::world, &log_b);
  EXPECT_ASSERT(added.after("b"), "not added before it");
}

TEST_F(ScheduleTest, refuses_view_parameters_outside_the_view_stage) {
  EXPECT_ASSERT(schedule_.add_system("v", "m", Stage::world | Stage::view, &log_view), "Stage::view alone");
  EXPECT_ASSERT(schedule_.run(Stage::view, world_, *executor_), "run_view");
}

}  // namespace
}  // namespace gloam
