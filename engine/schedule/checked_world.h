// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/ecs/access_checker.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/schedule/system.h"

namespace gloam {

/// During its lifetime, a system that accesses the world without having declared it, or makes a structural change,
/// fails an assertion. Accesses outside systems pass. It replaces the world's access checker and sets none when it is
/// destroyed.
class CheckedWorld final : public AccessChecker {
 public:
  explicit CheckedWorld(World& world) : world_(world) { world_.set_access_checker(this); }
  ~CheckedWorld() override { world_.set_access_checker(nullptr); }
  CheckedWorld(const CheckedWorld&) = delete;
  CheckedWorld& operator=(const CheckedWorld&) = delete;

  void component(ComponentId id, bool write) override;
  void resource(std::string_view type_name, bool write) override;
  void structure() override;

  /// During its lifetime, accesses of the calling thread to the checked world count as accesses of `system`.
  class Scope {
   public:
    Scope(const CheckedWorld& checker, const System& system);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    const CheckedWorld* outer_checker_;
    const System* outer_system_;
  };

 private:
  [[nodiscard]] const System* current() const;
  World& world_;
};

/// Forwards jobs to another executor and runs each inside a Scope of the system. The system's own Scope covers only the
/// thread that runs the system, while its jobs may run on any thread, even on one that is waiting inside another
/// system.
class CheckedExecutor final : public JobExecutor {
 public:
  CheckedExecutor(JobExecutor& inner, const CheckedWorld& checker, const System& system)
      : inner_(inner), checker_(checker), system_(system) {}

  [[nodiscard]] std::uint32_t worker_count() const override { return inner_.worker_count(); }
  void run(std::span<const std::function<void()>> jobs) override;
  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override;
  void run_graph(std::span<JobNode> nodes) override;

 private:
  JobExecutor& inner_;
  const CheckedWorld& checker_;
  const System& system_;
};

}  // namespace gloam
