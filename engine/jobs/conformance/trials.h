// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Internal to executor_faults: the jobs that it runs, and its checks.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/jobs/executor.h"

namespace gloam::conformance {

using Jobs = std::vector<std::function<void()>>;

/// The executor under check, and the memory that its jobs use.
struct Subject {
  JobExecutor& executor;
  std::uint32_t rounds = 1;
  std::vector<std::shared_ptr<void>> kept = {};

  /// Makes an object that lives as long as jobs may use it, also if the executor runs them too late.
  template <class T, class... Arguments>
  T& keep(Arguments&&... arguments) {
    auto made = std::make_shared<T>(std::forward<Arguments>(arguments)...);
    kept.push_back(made);
    return *made;
  }
};

/// Thrown by the failing jobs of the checks. Not a std::exception, because an executor must pass on any type.
struct JobFailed {
  std::size_t index = 0;
};

/// How a call of the executor ended.
struct Outcome {
  bool threw = false;
  std::optional<std::size_t> job;  ///< the index in a JobFailed
  std::string what;                ///< of another exception

  [[nodiscard]] std::string text() const {
    if (!threw) return "no exception";
    return job ? "the exception of job " + std::to_string(*job) : "another exception (" + what + ")";
  }
};

template <class Call>
Outcome outcome_of(Call&& call) {
  try {
    call();
    return {};
  } catch (const JobFailed& failed) {
    return {true, failed.index, {}};
  } catch (const std::exception& exception) {
    return {true, {}, exception.what()};
  } catch (...) {
    return {true, {}, "of unknown type"};
  }
}

/// Long enough for a call that does not wait for its jobs to return before them.
inline void pause_some(std::size_t index) {
  if (index % 16 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
}

/// Waits for an event of another job for a short time at most: that job may be waiting for this thread.
inline void await_briefly(const std::atomic<int>& events) {
  for (int i = 0; i < 40 && events.load() == 0; ++i) std::this_thread::sleep_for(std::chrono::microseconds(50));
}

/// Counts the starts and ends of jobs.
class Tally {
 public:
  explicit Tally(std::size_t jobs) : started_(jobs), ended_(jobs) {}

  template <class Work>
  void run(std::size_t job, Work&& work) {
    ++started_[job];
    ++inside_;
    try {
      work();
    } catch (...) {
      ++ended_[job];
      --inside_;
      throw;
    }
    ++ended_[job];
    --inside_;
  }
  void run(std::size_t job) {
    run(job, [job] { pause_some(job); });
  }

  [[nodiscard]] int started(std::size_t job) const { return started_[job].load(); }
  [[nodiscard]] int ended(std::size_t job) const { return ended_[job].load(); }
  [[nodiscard]] int inside() const { return inside_.load(); }
  [[nodiscard]] int starts() const {
    int sum = 0;
    for (const auto& started : started_) sum += started.load();
    return sum;
  }

  /// Names the first job that has not run `times` times; empty if there is none.
  [[nodiscard]] std::string fault(std::size_t begin, std::size_t end, int times = 1) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (ended(i) == times && started(i) == times) continue;
      return "job " + std::to_string(i) + " of " + std::to_string(ended_.size()) + " had run " +
             std::to_string(ended(i)) + " times when the call returned, not " + std::to_string(times);
    }
    return {};
  }
  [[nodiscard]] std::string fault() const { return fault(0, ended_.size()); }

 private:
  std::vector<std::atomic<int>> started_, ended_;
  std::atomic<int> inside_ = 0;
};

/// "", or the sentence of an exception or a wrong count after a call in which no job fails.
inline std::string fault_of(const char* call, const Outcome& outcome, const std::string& counts) {
  if (outcome.threw) return std::string(call) + ": threw " + outcome.text() + ", although no job of the call failed";
  return counts.empty() ? std::string() : std::string(call) + ": " + counts;
}

/// A job graph with the lists of its successors.
struct TrialGraph {
  explicit TrialGraph(std::size_t count) : successors(count), predecessors(count), nodes(count), tally(count) {}
  void edge(std::uint32_t from, std::uint32_t to) {
    successors[from].push_back(to);
    predecessors[to].push_back(from);
    ++nodes[to].predecessor_count;
    nodes[from].successors = successors[from];
  }
  std::vector<std::vector<std::uint32_t>> successors, predecessors;
  std::vector<JobNode> nodes;
  Tally tally;
  std::atomic<int> failures = 0;
  std::atomic<int> early = -1;  ///< a node that started before a predecessor had ended
};

/// Names of the calls that run_one_of makes, by kind.
inline constexpr const char* kCallKinds[] = {"run", "parallel_for", "run_graph"};
/// Runs a batch, a loop or a graph of 30 jobs (kind: index of kCallKinds), of which job 7 fails if `fails`.
Outcome run_one_of(Subject& s, int kind, Tally& tally, bool fails);

// The checks. Each returns the sentence of the broken rule, or nothing.
std::string counts_its_threads(Subject& s);
std::string does_nothing_without_jobs(Subject& s);
std::string runs_each_job_once(Subject& s);
std::string covers_each_index_once(Subject& s);
std::string runs_nodes_after_their_predecessors(Subject& s);

std::string rethrows_failures_of_batches(Subject& s);
std::string rethrows_failures_of_loops(Subject& s);
std::string skips_what_depends_on_failed_nodes(Subject& s);
std::string passes_exceptions_of_empty_functions(Subject& s);
std::string works_after_a_failure(Subject& s);

std::string nests(Subject& s);
std::string passes_failures_through_nested_calls(Subject& s);
std::string serves_several_threads_at_once(Subject& s);
/// Plain memory, for ThreadSanitizer: only for executors without other faults.
std::string orders_memory(Subject& s);

}  // namespace gloam::conformance
