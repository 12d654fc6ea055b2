// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/schedule.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/assert.h"
#include "engine/schedule/checked_world.h"
#include "engine/schedule/describe.h"
#include "engine/schedule/stage_plan.h"

namespace gloam {

/// Data shared by all systems of one run of a stage.
struct Schedule::Run {
  World& world;
  JobExecutor& executor;
  Profiler* zones = nullptr;
  ViewId view;
  const CheckedWorld* checker = nullptr;  ///< null: unchecked
};

/// A stage's plan as job nodes. The jobs find the current run through `run`.
struct Schedule::Graph {
  StagePlan plan;
  std::vector<JobNode> nodes;
  const Run* run = nullptr;
};

Schedule::Schedule() = default;
Schedule::~Schedule() = default;

Schedule::Added& Schedule::Added::after(std::string_view name) {
  std::uint32_t index = 0;
  while (schedule_.systems_[index].get() != &system_ && schedule_.systems_[index]->name != name) ++index;
  GLOAM_ASSERT(
      schedule_.systems_[index].get() != &system_,
      "system \"" + system_.name + "\" is to run after \"" + std::string(name) + "\", which was not added before it");
  system_.after.push_back(index);
  schedule_.forget_graphs();
  return *this;
}

Schedule::Added Schedule::add(std::string_view name, std::string_view module, Stage stages, SystemAccess access,
                              std::function<void(const SystemContext&)> run) {
  GLOAM_ASSERT(std::ranges::none_of(systems_, [&](const auto& system) { return system->name == name; }),
               "a system named \"" + std::string(name) + "\" was added already");
  GLOAM_ASSERT(!access.per_view || stages == Stage::view,
               "system \"" + std::string(name) + "\" takes something of a view, so it must be in Stage::view alone");
  forget_graphs();
  auto system = std::make_unique<System>();
  system->name = name;
  system->module = module;
  system->stages = stages;
  system->access = std::move(access);
  system->run = std::move(run);
  systems_.push_back(std::move(system));
  return {*this, *systems_.back()};
}

void Schedule::set_enabled(std::string_view module, bool enabled) {
  if (enabled == is_enabled(module)) return;
  forget_graphs();
  if (enabled) {
    disabled_.erase(disabled_.find(module));
  } else {
    disabled_.emplace(module);
  }
}

bool Schedule::is_enabled(std::string_view module) const { return !disabled_.contains(module); }

void Schedule::forget_graphs() {
  GLOAM_ASSERT(!running_, "a schedule is not changed while it runs");
  for (auto& graph : graphs_) graph.reset();
}

Schedule::Graph& Schedule::graph(Stage stage) {
  std::unique_ptr<Graph>& graph = graphs_[stage == Stage::world ? 0 : 1];
  if (graph != nullptr) return *graph;
  graph = std::make_unique<Graph>();
  graph->plan = plan_stage(systems_, stage, [&](const System& system) { return is_enabled(system.module); });
  for (const StagePlan::Node& node : graph->plan.nodes) {
    graph->nodes.push_back({[shared = graph.get(), system = systems_[node.system].get()] {
                              system->failed = true;  // until it has returned
                              run_system(*system, *shared->run);
                              system->failed = false;
                            },
                            node.successors, static_cast<std::uint32_t>(node.waits_for.size())});
  }
  return *graph;
}

void Schedule::run_system(System& system, const Run& run) {
  const ScopedZone zone(run.zones, system.name, system.module);
  if (run.checker == nullptr) {
    system.run({run.world, run.executor, system.commands, run.view});
    return;
  }
  const CheckedWorld::Scope scope(*run.checker, system);
  CheckedExecutor executor(run.executor, *run.checker, system);
  system.run({run.world, executor, system.commands, run.view});
}

void Schedule::run(Stage stage, World& world, JobExecutor& executor, Profiler* zones) {
  GLOAM_ASSERT(stage == Stage::world, "run() is for Stage::world; a view's stage is run by run_view()");
  run_stage(stage, {world, executor, zones, {}, nullptr});
}

void Schedule::run_view(ViewId view, World& world, JobExecutor& executor, Profiler* zones) {
  run_stage(Stage::view, {world, executor, zones, view, nullptr});
}

void Schedule::run_stage(Stage stage, Run run) {
  GLOAM_ASSERT(!running_, "a schedule runs one stage at a time");
  Graph& graph = this->graph(stage);
  std::optional<CheckedWorld> checker;
  if (checked_) run.checker = &checker.emplace(run.world);
  graph.run = &run;
  failed_system_ = {};
  for (const StagePlan::Node& node : graph.plan.nodes) systems_[node.system]->failed = false;
  running_ = true;
  try {
    run.executor.run_graph(graph.nodes);
    running_ = false;
  } catch (...) {
    running_ = false;
    // Nodes are in order of registration, and the exception is of the failed node with the lowest index.
    const auto failed =
        std::ranges::find_if(graph.plan.nodes, [&](const auto& node) { return systems_[node.system]->failed; });
    if (failed != graph.plan.nodes.end()) failed_system_ = systems_[failed->system]->name;
    for (const StagePlan::Node& node : graph.plan.nodes) systems_[node.system]->commands.clear();
    throw;
  }
  for (const StagePlan::Node& node : graph.plan.nodes) systems_[node.system]->commands.apply(run.world);
}

std::string Schedule::describe() const {
  const auto runs = [this](const System& system) { return is_enabled(system.module); };
  return describe_stage(systems_, Stage::world, runs) + describe_stage(systems_, Stage::view, runs);
}

}  // namespace gloam
