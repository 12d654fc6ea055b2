// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
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
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"

namespace gloam {
namespace {

constexpr int kRepetitions = 15;

std::uint64_t hash_of(std::span<const std::uint32_t> values) { return hash_bytes(std::as_bytes(values)); }

/// A batch of 100,000 jobs that count their calls, each in a cell of its own.
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

BenchValue run_empty_jobs(JobExecutor& executor) {
  const EmptyJobs jobs;
  auto times = time_ns(kRepetitions, {}, [&] { jobs.run(executor); });
  return per_item(std::move(times), EmptyJobs::kJobs, jobs.hash());
}

BenchValue compare_empty_jobs(JobExecutor& executor) {
  const EmptyJobs jobs;
  const auto one = make_pool_executor(1);
  const PairTimes times = time_pair_ns(kRepetitions, {.prepare = {}, .run = [&] { jobs.run(executor); }},
                                       {.prepare = {}, .run = [&] { jobs.run(*one); }});
  return ratio_of(times.a_ns, times.b_ns, jobs.hash());
}

/// Integer work that no compiler shortens: about 1.6 ns a round.
std::uint32_t grind(std::uint32_t value, int rounds) {
  for (int round = 0; round < rounds; ++round) value = (value ^ (value >> 15)) * 0x2c1b3c6du + 1u;
  return value;
}

/// How much of the workers' time a parallel_for uses whose 8,100 items take about a microsecond each:
/// serial time / (parallel time · workers).
BenchValue run_parallel_for(JobExecutor& pool) {
  constexpr std::size_t kItems = 8100;
  constexpr int kRounds = 640;
  std::vector<std::uint32_t> results(kItems);
  const auto body = [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) results[i] = grind(static_cast<std::uint32_t>(i), kRounds);
  };
  const auto serial = make_serial_executor();
  PairTimes times = time_pair_ns(kRepetitions, {.prepare = {}, .run = [&] { serial->parallel_for(kItems, 1, body); }},
                                 {.prepare = {}, .run = [&] { pool.parallel_for(kItems, 1, body); }});
  for (double& time : times.b_ns) time *= pool.worker_count();
  return ratio_of(times.a_ns, times.b_ns, hash_of(results));
}

/// 50 levels of 20 nodes. Each node waits for two of the level above, in the first two of these levels for three: 1000
/// nodes, 2000 edges.
BenchValue run_graph_nodes(JobExecutor& executor) {
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
  auto times = time_ns(kRepetitions, {}, [&] {
    for (int run = 0; run < 10; ++run) executor.run_graph(nodes);
  });
  return per_item(std::move(times), 10.0 * static_cast<double>(nodes.size()), hash_of(cells));
}

/// Two jobs that meet: neither begins its work before the other has started, so that both cores are engaged, and they
/// have to be engaged soon. A job that waits in vain goes on after a while.
class Meeting {
 public:
  static constexpr int kRounds =
      2000;  ///< about 3 µs of work: of less the executor may think that it does not pay a second core

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
  /// What one of the jobs does once both are there.
  void work(std::size_t job) { results_[job * kApart] = grind(results_[job * kApart], kRounds); }
  [[nodiscard]] std::uint64_t hash() const { return hash_of(results_); }

 private:
  static constexpr std::size_t kApart = 16;  // on lines of their own

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

/// What engaging both cores adds to two jobs: the time of a batch of two that meet, less the time of one's work alone.
/// A meeting that is missed costs the patience of the job that waited.
BenchValue run_fork_join(JobExecutor& executor) {
  constexpr int kForks = 500;
  Meeting meeting;
  const auto fork = [&] {
    for (int i = 0; i < kForks; ++i) meeting.run(executor);
  };
  const auto alone = [&] {
    for (int i = 0; i < kForks; ++i) meeting.work(0);
  };
  // Hot: while one works alone the other core has gone to sleep.
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
  BenchValue (*run)(JobExecutor&);
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
  registry.add({.id = "jobs.empty.one_thread",
                .unit = "ns/job",
                .bar = {},
                .better = Better::lower,
                .run = [](BenchContext&) -> Result<BenchValue> { return run_empty_jobs(*make_pool_executor(1)); }});
}

}  // namespace gloam
