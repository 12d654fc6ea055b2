// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <condition_variable>
#include <iterator>
#include <mutex>

#include "engine/jobs/conformance/trials.h"
#include "engine/jobs/executor_conformance.h"

namespace gloam {
namespace {

using namespace conformance;

struct Rule {
  const char* name;
  std::string (*check)(Subject&);
  /// Runs only if no check before has found a fault: its jobs refer to the stack of the check, or race if another rule
  /// is broken.
  bool of_sound_executors = false;
};
constexpr Rule kRules[] = {
    {"worker_count and an empty parallel_for", &counts_its_threads},
    {"calls without jobs", &does_nothing_without_jobs},
    {"run", &runs_each_job_once},
    {"parallel_for", &covers_each_index_once},
    {"run_graph", &runs_nodes_after_their_predecessors},
    {"run, jobs fail", &rethrows_failures_of_batches},
    {"parallel_for, jobs fail", &rethrows_failures_of_loops},
    {"run_graph, nodes fail", &skips_what_depends_on_failed_nodes},
    {"run, a function is empty", &passes_exceptions_of_empty_functions},
    {"a call after a failed one", &works_after_a_failure},
    {"nested calls", &nests, true},
    {"failures in nested calls", &passes_failures_through_nested_calls, true},
    {"calls of several threads at once", &serves_several_threads_at_once, true},
    {"the order of memory accesses", &orders_memory, true},
};

/// Progress of the checking thread, shared with the caller of executor_faults.
struct Progress {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t checks = 0;  ///< that have ended
  bool abandoned = false;  ///< no further check begins
  std::vector<std::string> faults;
  std::vector<std::shared_ptr<void>> kept;
};

void run_checks(JobExecutor& executor, std::uint32_t rounds, const std::shared_ptr<Progress>& progress) {
  bool sound = true;
  for (const Rule& rule : kRules) {
    auto subject = std::make_unique<Subject>(Subject{executor, rounds});
    std::string fault;
    const Outcome outcome = outcome_of([&] {
      if (sound || !rule.of_sound_executors) fault = rule.check(*subject);
    });
    if (outcome.threw) fault = std::string(rule.name) + ": threw " + outcome.text() + ", although no job failed";
    sound = sound && fault.empty();
    const std::lock_guard lock(progress->mutex);
    if (!fault.empty()) progress->faults.push_back(std::move(fault));
    progress->kept.push_back(std::shared_ptr<void>(std::move(subject)));
    ++progress->checks;
    progress->changed.notify_all();
    if (progress->abandoned) return;
  }
}

/// Never freed: see executor_faults.
void keep_for_ever(std::shared_ptr<Progress> progress) {
  static std::mutex mutex;
  static auto* const kept = new std::vector<std::shared_ptr<Progress>>();
  const std::lock_guard lock(mutex);
  kept->push_back(std::move(progress));
}

}  // namespace

std::vector<std::string> executor_faults(JobExecutor& executor, const ExecutorCheck& check) {
  const auto progress = std::make_shared<Progress>();
  // On another thread: it can be left behind if a call never returns, and the executor does not know it.
  std::thread thread(
      [&executor, rounds = std::max(1u, check.rounds), progress] { run_checks(executor, rounds, progress); });
  std::unique_lock lock(progress->mutex);
  for (std::size_t i = 0; i < std::size(kRules); ++i) {
    if (progress->changed.wait_for(lock, check.hang_limit, [&] { return progress->checks > i; })) continue;
    std::vector<std::string> faults = progress->faults;
    faults.push_back(std::string(kRules[i].name) + ": did not return within " +
                     std::to_string(check.hang_limit.count()) + " ms");
    progress->abandoned = true;
    lock.unlock();
    keep_for_ever(progress);
    thread.detach();
    return faults;
  }
  std::vector<std::string> faults = progress->faults;
  lock.unlock();
  thread.join();
  if (!faults.empty()) keep_for_ever(progress);
  return faults;
}

}  // namespace gloam
