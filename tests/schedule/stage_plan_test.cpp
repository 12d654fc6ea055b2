// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/stage_plan.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "engine/schedule/schedule.h"

namespace gloam {
namespace {

struct A {};
struct B {};

void write_a(Resource<A>) {}
void read_a(Resource<const A>) {}
void read_a_write_b(Resource<const A>, Resource<B>) {}
void write_both(Resource<A>, Resource<B>) {}

using Systems = std::vector<std::unique_ptr<System>>;
using Waits = std::vector<std::vector<std::uint32_t>>;

template <class Function>
void add(Systems& systems, Function* function, Stage stages = Stage::world, std::vector<std::uint32_t> after = {}) {
  auto system = std::make_unique<System>();
  system->stages = stages;
  system->access = access_of(function);
  system->after = std::move(after);
  systems.push_back(std::move(system));
}

StagePlan plan(const Systems& systems, Stage stage = Stage::world) {
  return plan_stage(systems, stage, [](const System&) { return true; });
}

Waits waits(const StagePlan& plan) {
  Waits result;
  for (const StagePlan::Node& node : plan.nodes) result.push_back(node.waits_for);
  return result;
}

TEST(stage_plan, lets_readers_run_side_by_side_between_writers) {
  Systems systems;
  add(systems, &write_a);
  add(systems, &read_a);
  add(systems, &read_a);
  add(systems, &write_a);
  EXPECT_EQ(waits(plan(systems)), (Waits{{}, {0}, {0}, {1, 2}}));
}

TEST(stage_plan, leaves_out_edges_that_others_imply) {
  Systems systems;
  add(systems, &write_a);
  add(systems, &read_a_write_b);
  add(systems, &write_both);
  add(systems, &write_a);
  const StagePlan result = plan(systems);
  EXPECT_EQ(waits(result), (Waits{{}, {0}, {1}, {2}}));
  EXPECT_EQ(result.nodes[0].successors, std::vector<std::uint32_t>{1});
}

TEST(stage_plan, obeys_after_where_nothing_conflicts) {
  Systems systems;
  add(systems, &read_a);
  add(systems, &read_a);
  add(systems, &read_a, Stage::world, {0});
  EXPECT_EQ(waits(plan(systems)), (Waits{{}, {}, {0}}));
}

TEST(stage_plan, takes_systems_of_its_stage_that_run) {
  Systems systems;
  add(systems, &write_a, Stage::view);
  add(systems, &write_a, Stage::world | Stage::view);
  add(systems, &write_a, Stage::world);
  EXPECT_EQ(plan(systems).nodes.size(), 2u);
  EXPECT_EQ(plan(systems, Stage::view).nodes[1].system, 1u);
  const StagePlan one = plan_stage(systems, Stage::world, [&](const System& s) { return &s != systems[1].get(); });
  ASSERT_EQ(one.nodes.size(), 1u);
  EXPECT_EQ(one.nodes[0].system, 2u);
  EXPECT_TRUE(one.nodes[0].waits_for.empty());
}

}  // namespace
}  // namespace gloam
