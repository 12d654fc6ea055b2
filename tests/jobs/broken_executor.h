// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/jobs/executor.h"

namespace gloam::test {

/// The rule of JobExecutor that a BrokenExecutor breaks.
enum class Flaw : std::uint8_t {
  none,
  no_threads,
  thread_count_changes,
  calls_the_body_for_nothing,
  throws_without_jobs,
  drops_the_last_job,
  runs_a_job_twice,
  returns_early,
  ranges_overlap,
  ignores_the_grain,
  range_count_overflows,
  ordinals_from_the_back,
  runs_successors_early,
  runs_double_edges_early,
  changes_the_nodes,
  drops_unreached_nodes,
  swallows_exceptions,
  rethrows_the_latest_failure,
  stops_below_the_lowest_failure,
  knows_standard_exceptions_only,
  hides_the_type_of_exceptions,
  runs_dependents_of_failed_nodes,
  skips_all_nodes_after_a_failure,
  stops_for_ever_after_a_failure,
  throws_a_failure_again,
  refuses_nested_calls,
  blocks_in_nested_calls,
  loses_exceptions_of_nested_calls,
  drops_jobs_of_other_threads,
  mixes_failures_of_threads,
};

/// Runs everything on the calling thread and breaks one rule. With Flaw::blocks_in_nested_calls it must never be
/// destroyed.
class BrokenExecutor final : public JobExecutor {
 public:
  explicit BrokenExecutor(Flaw flaw) : flaw_(flaw) {}
  ~BrokenExecutor() override {
    for (std::thread& thread : late_) thread.join();
  }

  [[nodiscard]] std::uint32_t worker_count() const override {
    return has(Flaw::no_threads) ? 0 : has(Flaw::thread_count_changes) ? calls_.load() + 1 : 1;
  }

  void run(std::span<const std::function<void()>> jobs) override {
    run_all(jobs.size(), [jobs](std::size_t i) { jobs[i](); });
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override {
    if (count == 0 && has(Flaw::calls_the_body_for_nothing)) body({});
    if (has(Flaw::ignores_the_grain)) grain = count;
    const std::size_t ranges = has(Flaw::range_count_overflows) ? (count + grain - 1) / grain
                               : count == 0                     ? 0
                                                                : (count - 1) / grain + 1;
    run_all(ranges, [this, count, grain, ranges, &body](std::size_t i) {
      JobRange range{i * grain, i * grain + std::min(grain, count - i * grain), i};
      if (has(Flaw::ranges_overlap) && i > 0) --range.begin;
      if (has(Flaw::ordinals_from_the_back)) range.ordinal = ranges - 1 - i;
      body(range);
    });
  }

  void run_graph(std::span<JobNode> nodes) override;

 private:
  [[nodiscard]] bool has(Flaw flaw) const { return flaw_ == flaw; }

  /// Begins a call. Flaws that depend on other calls show here.
  void enter(std::size_t jobs);

  template <class Job>
  void run_all(std::size_t count, Job job) {
    const Inside inside(*this, count);
    if (has(Flaw::returns_early) && count > 1) {
      const std::lock_guard lock(mutex_);
      late_.emplace_back([count, job] {
        for (std::size_t i = 0; i < count; ++i) {
          std::this_thread::sleep_for(std::chrono::microseconds(20));
          try {
            job(i);
          } catch (...) {  // no one waits for it
          }
        }
      });
      return;
    }
    if (has(Flaw::drops_the_last_job) && count > 2) --count;
    if (has(Flaw::drops_jobs_of_other_threads) && others_call()) count /= 2;
    std::exception_ptr failure;
    for (std::size_t n = 0; n < count; ++n) {
      const bool backward = has(Flaw::rethrows_the_latest_failure) || has(Flaw::stops_below_the_lowest_failure);
      const std::size_t i = backward ? count - 1 - n : n;
      if (attempt(failure, [&] { job(i); })) continue;
      if (has(Flaw::rethrows_the_latest_failure) || has(Flaw::stops_below_the_lowest_failure)) break;
    }
    if (has(Flaw::runs_a_job_twice) && count > 3) job(3);
    end(failure);
  }

  /// Runs a job. Keeps its exception if it is the first one, and returns false.
  template <class Job>
  bool attempt(std::exception_ptr& failure, Job&& job) {
    try {
      job();
      return true;
    } catch (const std::exception& exception) {
      if (failure == nullptr) failure = std::current_exception();
    } catch (...) {
      if (has(Flaw::knows_standard_exceptions_only)) return true;
      if (failure == nullptr) failure = std::current_exception();
    }
    return false;
  }
  void end(std::exception_ptr failure);
  [[nodiscard]] bool others_call() const { return inside_.load() > depth_of_thread(); }
  static int& depth_of_thread() {
    thread_local int depth = 0;
    return depth;
  }

  struct Inside {
    Inside(BrokenExecutor& executor, std::size_t jobs) : owner(executor) {
      ++owner.inside_;
      ++depth_of_thread();
      try {
        owner.enter(jobs);
      } catch (...) {
        leave();
        throw;
      }
    }
    ~Inside() { leave(); }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    void leave() const {
      --owner.inside_;
      --depth_of_thread();
    }
    BrokenExecutor& owner;
  };

  const Flaw flaw_;
  std::atomic<std::uint32_t> calls_ = 0;
  std::atomic<int> inside_ = 0;  ///< calls that are running, on all threads
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_failed_ = false;
  std::exception_ptr last_failure_;
  std::vector<std::thread> late_;
};

inline void BrokenExecutor::enter(std::size_t jobs) {
  ++calls_;
  const bool nested = depth_of_thread() > 1;
  if (has(Flaw::throws_without_jobs) && jobs == 0) throw std::logic_error("there are no jobs");
  if (has(Flaw::refuses_nested_calls) && nested) throw std::logic_error("the pool is busy");
  if ((has(Flaw::drops_jobs_of_other_threads) || has(Flaw::mixes_failures_of_threads)) && !nested) {
    std::this_thread::sleep_for(std::chrono::microseconds(500));  // so that calls of several threads overlap
  }
  std::unique_lock lock(mutex_);
  if (has(Flaw::stops_for_ever_after_a_failure) && has_failed_) throw std::logic_error("the pool has stopped");
  if (has(Flaw::throws_a_failure_again) && last_failure_ != nullptr)
    std::rethrow_exception(std::exchange(last_failure_, {}));
  if (!has(Flaw::blocks_in_nested_calls) || !nested) return;
  while (true) changed_.wait(lock);
}

inline void BrokenExecutor::end(std::exception_ptr failure) {
  const std::unique_lock lock(mutex_);
  if (failure != nullptr) {
    has_failed_ = true;
    last_failure_ = failure;
  }
  if (has(Flaw::swallows_exceptions)) return;
  if (has(Flaw::loses_exceptions_of_nested_calls) && depth_of_thread() > 1) return;
  if (has(Flaw::mixes_failures_of_threads) && others_call() && failure == nullptr)
    failure = std::exchange(last_failure_, {});
  if (failure == nullptr) return;
  if (!has(Flaw::hides_the_type_of_exceptions)) std::rethrow_exception(failure);
  throw std::runtime_error("a job failed");
}

inline void BrokenExecutor::run_graph(std::span<JobNode> nodes) {
  const Inside inside(*this, nodes.size());
  std::exception_ptr failure;
  std::vector<std::uint32_t> missing(nodes.size());
  std::vector<bool> skipped(nodes.size()), ran(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) missing[i] = nodes[i].predecessor_count;
  std::vector<std::size_t> ready;
  for (std::size_t i = nodes.size(); i-- > 0;)
    if (missing[i] == 0 || has(Flaw::runs_successors_early)) ready.push_back(i);
  if (has(Flaw::runs_successors_early)) std::reverse(ready.begin(), ready.end());  // the last node first
  if (has(Flaw::drops_unreached_nodes)) ready.erase(ready.begin(), ready.end() - (nodes.empty() ? 0 : 1));
  while (!ready.empty()) {
    const std::size_t i = ready.back();
    ready.pop_back();
    if (ran[i]) continue;
    ran[i] = true;
    if (failure != nullptr && has(Flaw::skips_all_nodes_after_a_failure)) skipped[i] = true;
    if (!skipped[i]) {
      const bool failed = !attempt(failure, [&] { nodes[i].work(); });
      skipped[i] = failed && !has(Flaw::runs_dependents_of_failed_nodes);
    }
    for (const std::uint32_t successor : nodes[i].successors) {
      if (skipped[i]) skipped[successor] = true;
      if (has(Flaw::changes_the_nodes)) --nodes[successor].predecessor_count;
      const bool first_edge = missing[successor] > 0 && --missing[successor] > 0;
      if (!first_edge || has(Flaw::runs_double_edges_early)) ready.push_back(successor);
    }
  }
  end(failure);
}

}  // namespace gloam::test
