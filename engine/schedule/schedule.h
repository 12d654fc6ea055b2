// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/profiler.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/schedule/system.h"

namespace gloam {

/// Runs systems in the order that their signatures require. Per stage: systems that conflict (one writes what the other
/// reads or writes) run in order of registration, others in any order or at the same time. When all have ended, their
/// commands are applied in order of registration. Results do not depend on the executor, provided that systems access
/// only what they declare.
///
/// Use it from one thread at a time. A stage's graph is built on the first run after systems were added or modules were
/// enabled or disabled.
class Schedule {
 public:
  /// Refers to the system just added, to state further constraints.
  class Added {
   public:
    /// Makes the system wait for system `name` as well, in every stage that both belong to. `name` must have been added
    /// before.
    Added& after(std::string_view name);

   private:
    friend class Schedule;
    Added(Schedule& schedule, System& system) : schedule_(schedule), system_(system) {}
    Schedule& schedule_;
    System& system_;
  };

  Schedule();
  ~Schedule();
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  /// Names are unique. A system that takes a ViewResource or ViewId must be in Stage::view alone.
  template <class... Parameters>
  Added add_system(std::string_view name, std::string_view module, Stage stages, void (*function)(Parameters...)) {
    return add(name, module, stages, access_of(function), bind_system(function));
  }

  /// Modules are enabled by default. Systems of disabled modules do not run.
  void set_enabled(std::string_view module, bool enabled);
  [[nodiscard]] bool is_enabled(std::string_view module) const;

  /// If set, an access that a system did not declare fails an assertion (see CheckedWorld). Slower; for tests and
  /// debugging.
  void set_checked(bool checked) { checked_ = checked; }

  /// Runs the systems of Stage::world (the only stage allowed here). `zones` receives one zone per system; may be null.
  /// If systems throw, rethrows the exception of the one registered first: systems that wait for a failed one are
  /// skipped, all others run, and the commands of the stage are dropped.
  void run(Stage stage, World& world, JobExecutor& executor, Profiler* zones = nullptr);
  /// As run(), for the systems of Stage::view and this view.
  void run_view(ViewId view, World& world, JobExecutor& executor, Profiler* zones = nullptr);

  /// The name of the system whose exception the last run() or run_view() has rethrown; empty if it threw none.
  [[nodiscard]] std::string_view failed_system() const { return failed_system_; }

  /// One line per system and stage: stage, name, module, reads, writes, recorded commands, and the systems it waits
  /// for.
  [[nodiscard]] std::string describe() const;

 private:
  struct Graph;
  struct Run;

  Added add(std::string_view name, std::string_view module, Stage stages, SystemAccess access,
            std::function<void(const SystemContext&)> run);
  void run_stage(Stage stage, Run run);
  Graph& graph(Stage stage);
  void forget_graphs();
  static void run_system(System& system, const Run& run);

  std::vector<std::unique_ptr<System>> systems_;
  std::set<std::string, std::less<>> disabled_;
  bool checked_ = false;
  bool running_ = false;
  std::string_view failed_system_;
  std::array<std::unique_ptr<Graph>, 2> graphs_;  ///< graphs of Stage::world and Stage::view; null until needed
};

}  // namespace gloam
