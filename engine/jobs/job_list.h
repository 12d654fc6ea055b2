// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/arena.h"
#include "engine/core/assert.h"
#include "engine/jobs/executor.h"

namespace gloam {

/// Separate jobs that are added one by one and then run together, in no particular order. Each job has its own type and
/// state; the states lie in an arena. A reused list allocates nothing while it has no more jobs than before. Meant for
/// many short jobs. Use JobExecutor::run for a fixed batch, parallel_for for one body with an index.
///
/// Add, run and clear from one thread at a time. A job must not change the list that it runs from (asserted).
class JobList {
 public:
  JobList() = default;
  ~JobList() { clear(); }
  JobList(const JobList&) = delete;
  JobList& operator=(const JobList&) = delete;

  /// Adds a job that owns `callable`, which may be move-only. Its index is the number of jobs added before it.
  template <class Callable>
  void add(Callable&& callable) {
    using State = std::decay_t<Callable>;
    static_assert(std::invocable<State&>, "a job is called without arguments");
    assert_not_running();
    auto* const state = reinterpret_cast<State*>(states_.allocate_bytes(sizeof(State), alignof(State)));
    std::construct_at(state, std::forward<Callable>(callable));
    if (jobs_.empty()) run_all_ = &run_all<State>;
    jobs_.push_back({state, [](void* job) { (*static_cast<State*>(job))(); }});
    if constexpr (!std::is_trivially_destructible_v<State>)
      destructors_.push_back({state, [](void* job) { std::destroy_at(static_cast<State*>(job)); }});
  }

  [[nodiscard]] std::size_t size() const { return jobs_.size(); }

  /// Runs every job once and returns when all have ended. As with JobExecutor::run, the exception of the failed job
  /// with the lowest index is rethrown; jobs with a higher index may be skipped. The list is empty afterwards, also if
  /// a job threw.
  void run(JobExecutor& executor);

  /// Destroys all jobs without running them, in the order of adding. Keeps the memory.
  void clear();

 private:
  struct Call {
    void* state = nullptr;
    void (*function)(void* state) = nullptr;
  };

  /// The pool executor remembers the cost of a loop by the type of its body (see SiteCosts). The template parameter
  /// makes that type differ between lists whose first jobs differ in type.
  template <class FirstState>
  static void run_all(JobExecutor& executor, std::span<const Call> jobs) {
    executor.parallel_for(jobs.size(), 1, [jobs](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) jobs[i].function(jobs[i].state);
    });
  }
  void assert_not_running() const {
    GLOAM_ASSERT(!running_, "a job list must not be changed by its own jobs while it runs");
  }

  Arena states_;
  std::vector<Call> jobs_;
  std::vector<Call> destructors_;  ///< only for states that need one
  void (*run_all_)(JobExecutor& executor, std::span<const Call> jobs) = nullptr;
  bool running_ = false;
};

}  // namespace gloam
