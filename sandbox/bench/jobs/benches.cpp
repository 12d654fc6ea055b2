// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "engine/jobs/executor.h"
#include "engine/jobs/job_list.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"

namespace gloam {
namespace {

constexpr int kJobRepetitions = 15;

std::uint64_t hash_of(std::span<const std::uint32_t> values) { return hash_bytes(std::as_bytes(values)); }

/// One batch of 100,000 jobs, created before the clock starts. Each counts its calls in its own cell.
class EmptyJobs {
 public:
  EmptyJobs() : cells_(kJobs) {
    jobs_.reserve(kJobs);
    for (std::uint32_t& cell : cells_) jobs_.emplace_back([&cell] { ++cell; });
  }
  void run(JobExecutor& executor) const { executor.run(jobs_); }
  [[nodiscard]] std::uint64_t hash() const { return hash_of(cells_); }

  static constexpr std::size_t kJobs = 100000;

 private:
  std::vector<std::uint32_t> cells_;
  std::vector<std::function<void()>> jobs_;
};

Result<BenchValue> run_empty_jobs(JobExecutor& executor) {
  const EmptyJobs jobs;
  auto times = time_ns(kJobRepetitions, {}, [&] { jobs.run(executor); });
  return per_item(std::move(times), EmptyJobs::kJobs, jobs.hash());
}

Result<BenchValue> compare_empty_jobs(JobExecutor& executor) {
  const EmptyJobs jobs;
  const auto one = make_pool_executor(1);
  const PairTimes times = time_pair_ns(kJobRepetitions, {.prepare = {}, .run = [&] { jobs.run(executor); }},
                                       {.prepare = {}, .run = [&] { jobs.run(*one); }});
  return ratio_of(times.a_ns, times.b_ns, jobs.hash());
}

/// 100,000 separate jobs: each is created, run and destroyed while the clock runs. They are of two types with different
/// state. Each adds its own amount to its own cell.
class SpawnedJobs {
 public:
  static constexpr std::size_t kJobs = 100000;

  void run(JobExecutor& executor) {
    for (std::size_t i = 0; i < kJobs; ++i) add(i);
    list_.run(executor);
    ++rounds_;
  }
  /// Whether every job of every round ran exactly once.
  [[nodiscard]] bool all_ran() const {
    for (std::size_t i = 0; i < kJobs; ++i)
      if (cells_[i] != rounds_ * amount(i)) return false;
    return true;
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_of(cells_); }

 private:
  static std::uint32_t amount(std::size_t i) { return static_cast<std::uint32_t>(i % 1000 + 1); }
  void add(std::size_t i) {
    std::uint32_t& cell = cells_[i];
    if (i % 2 == 0) {
      list_.add([&cell, amount = amount(i)] { cell += amount; });
    } else {
      const std::array<std::uint32_t, 4> parts = {1, 2, 3, amount(i) - 6u};
      list_.add([&cell, parts] {
        for (const std::uint32_t part : parts) cell += part;
      });
    }
  }

  std::vector<std::uint32_t> cells_ = std::vector<std::uint32_t>(kJobs);
  std::uint32_t rounds_ = 0;
  JobList list_;
};

Result<BenchValue> run_spawned_jobs(BenchContext&) {
  const auto two_workers = make_pool_executor(2);
  SpawnedJobs jobs;
  auto times = time_ns(kJobRepetitions, {}, [&] { jobs.run(*two_workers); });
  if (!jobs.all_ran()) return Error{ErrorKind::failed, "jobs.spawn: a job did not run exactly once a round"};
  return per_item(std::move(times), SpawnedJobs::kJobs, jobs.hash());
}

/// Integer work that no compiler shortens: about 1.6 ns per round.
std::uint32_t grind(std::uint32_t value, int rounds) {
  for (int round = 0; round < rounds; ++round) value = (value ^ (value >> 15)) * 0x2c1b3c6du + 1u;
  return value;
}

/// One item of about a microsecond for each result.
void grind_all(JobExecutor& executor, std::span<std::uint32_t> results) {
  constexpr int kRounds = 640;
  executor.parallel_for(results.size(), 1, [results](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) results[i] = grind(static_cast<std::uint32_t>(i), kRounds);
  });
}

/// How much of the workers' time a parallel_for uses whose 8,100 items take about a microsecond each:
/// serial time / (parallel time · workers).
Result<BenchValue> run_parallel_for(JobExecutor& pool) {
  constexpr std::size_t kItems = 8100;
  std::vector<std::uint32_t> serial_results(kItems);
  std::vector<std::uint32_t> pool_results(kItems);
  const auto serial = make_serial_executor();
  // Cleared before each run: a repetition cannot pass with the results of the one before.
  const auto side = [](JobExecutor& executor, std::vector<std::uint32_t>& results) {
    return TimedCall{.prepare = [&] { std::ranges::fill(results, 0u); }, .run = [&] { grind_all(executor, results); }};
  };
  PairTimes times = time_pair_ns(kJobRepetitions, side(*serial, serial_results), side(pool, pool_results));
  if (serial_results != pool_results)
    return Error{ErrorKind::failed, "jobs.parallel_for_efficiency: the pool's results differ from the serial ones"};
  for (double& time : times.b_ns) time *= pool.worker_count();
  return ratio_of(times.a_ns, times.b_ns, hash_of(pool_results));
}

/// 50 levels of 20 nodes: 1000 nodes, 2000 edges. Each node waits for two nodes of the level above; nodes of the second
/// and third level wait for three.
Result<BenchValue> run_graph_nodes(JobExecutor& executor) {
  constexpr std::uint32_t kLevels = 50;
  constexpr std::uint32_t kWidth = 20;
  std::vector<std::uint32_t> cells(std::size_t{kLevels} * kWidth);
  std::vector<std::array<std::uint32_t, 3>> successors(cells.size());
  std::vector<JobNode> nodes(cells.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t level = i / kWidth;
    const std::size_t edges = level + 1 == kLevels ? 0 : level < 2 ? 3 : 2;
    for (std::uint32_t e = 0; e < edges; ++e) {
      successors[i][e] = (level + 1) * kWidth + (i + e) % kWidth;
      ++nodes[successors[i][e]].predecessor_count;
    }
    nodes[i].work = [&cell = cells[i]] { ++cell; };
    nodes[i].successors = std::span(successors[i].data(), edges);
  }
  auto times = time_ns(kJobRepetitions, {}, [&] {
    for (int run = 0; run < 10; ++run) executor.run_graph(nodes);
  });
  return per_item(std::move(times), 10.0 * static_cast<double>(nodes.size()), hash_of(cells));
}

/// Two jobs that meet: neither begins its work before the other has started, so both cores must take part, and soon. A
/// job that has waited for kPatience goes on alone.
class Meeting {
 public:
  static constexpr int kRounds = 2000;  ///< about 3 µs of work: for less the executor may not engage a second core

  Meeting() {
    jobs_.emplace_back([this] { attend(0); });
    jobs_.emplace_back([this] { attend(1); });
  }
  Meeting(const Meeting&) = delete;
  Meeting& operator=(const Meeting&) = delete;

  void run(JobExecutor& executor) {
    started_.store(0, std::memory_order_relaxed);
    executor.run(jobs_);
  }
  /// The work of one job after the meeting.
  void work(std::size_t job) { results_[job * kApart] = grind(results_[job * kApart], kRounds); }
  [[nodiscard]] std::uint64_t hash() const { return hash_of(results_); }

 private:
  static constexpr std::size_t kApart = 16;  // on separate cache lines

  void attend(std::size_t job) {
    constexpr std::chrono::microseconds kPatience{100};
    started_.fetch_add(1, std::memory_order_acq_rel);
    if (started_.load(std::memory_order_acquire) < 2) {
      const auto deadline = std::chrono::steady_clock::now() + kPatience;
      while (started_.load(std::memory_order_acquire) < 2) {
        if (std::chrono::steady_clock::now() >= deadline) break;
      }
    }
    work(job);
  }

  alignas(64) std::atomic<int> started_ = 0;
  alignas(64) std::array<std::uint32_t, 2 * kApart> results_{};
  std::vector<std::function<void()>> jobs_;
};

/// Time to engage both cores: the time of a batch of two jobs that meet, less the time of one job's work alone. A
/// missed meeting adds kPatience.
Result<BenchValue> run_fork_join(JobExecutor& executor) {
  constexpr int kForks = 500;
  Meeting meeting;
  const auto fork = [&] {
    for (int i = 0; i < kForks; ++i) meeting.run(executor);
  };
  const auto alone = [&] {
    for (int i = 0; i < kForks; ++i) meeting.work(0);
  };
  // Wakes the second core, which sleeps while the other side runs alone.
  const auto warm_up = [&] {
    for (int i = 0; i < 100; ++i) meeting.run(executor);
  };
  const PairTimes times = time_pair_ns(31, {.prepare = warm_up, .run = fork}, {.prepare = {}, .run = alone});
  return excess_of(times.a_ns, times.b_ns, kForks, meeting.hash());
}

struct JobRow {
  const char* id;
  const char* unit;
  double bar;
  Better better;
  Result<BenchValue> (*run)(JobExecutor&);
};

}  // namespace

void add_job_benches(BenchRegistry& registry) {
  const JobRow rows[] = {
      {"jobs.empty", "ns/job", 237.0, Better::lower, &run_empty_jobs},
      {"jobs.empty.over_one_thread", "ratio", 1.0, Better::lower, &compare_empty_jobs},
      {"jobs.parallel_for_efficiency", "ratio", 0.95, Better::higher, &run_parallel_for},
      {"jobs.graph_node", "ns/node", 157.0, Better::lower, &run_graph_nodes},
      {"jobs.fork_join", "ns", 1500.0, Better::lower, &run_fork_join},
  };
  for (const JobRow& row : rows) {
    registry.add({.id = row.id,
                  .unit = row.unit,
                  .bar = row.bar,
                  .better = row.better,
                  .run = [run = row.run](BenchContext& context) -> Result<BenchValue> {
                    const auto executor = make_pool_executor(context.options().threads);
                    return run(*executor);
                  }});
  }
  registry.add({.id = "jobs.spawn", .unit = "ns/job", .bar = 120.0, .better = Better::lower, .run = &run_spawned_jobs});
  registry.add({.id = "jobs.empty.one_thread",
                .unit = "ns/job",
                .bar = {},
                .better = Better::lower,
                .run = [](BenchContext&) -> Result<BenchValue> { return run_empty_jobs(*make_pool_executor(1)); }});
}

}  // namespace gloam
