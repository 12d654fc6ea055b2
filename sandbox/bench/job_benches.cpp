// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "engine/jobs/executor.h"
#include "sandbox/bench/benches.h"
#include "sandbox/bench/context.h"
#include "sandbox/bench/measure.h"

namespace gloam {
namespace {

constexpr int kRepetitions = 15;

std::uint64_t hash_of(std::span<const std::uint32_t> values) { return hash_bytes(std::as_bytes(values)); }

/// One batch of 100,000 jobs that count their calls, each in a cell of its own.
BenchValue run_empty_jobs(JobExecutor& executor) {
  constexpr std::size_t kJobs = 100000;
  std::vector<std::uint32_t> cells(kJobs);
  std::vector<std::function<void()>> jobs;
  jobs.reserve(kJobs);
  for (std::uint32_t& cell : cells) jobs.emplace_back([&cell] { ++cell; });
  auto times = time_ns(kRepetitions, {}, [&] { executor.run(jobs); });
  return per_item(std::move(times), kJobs, hash_of(cells));
}

/// Integer work that no compiler shortens.
std::uint32_t grind(std::uint32_t value) {
  for (int round = 0; round < 64; ++round) value = (value ^ (value >> 15)) * 0x2c1b3c6du + 1u;
  return value;
}

/// How much of the workers' time a parallel_for over even work uses: serial time / (parallel time · workers).
BenchValue run_parallel_for(JobExecutor& pool) {
  constexpr std::size_t kItems = 400000;
  constexpr std::size_t kGrain = 4096;
  std::vector<std::uint32_t> results(kItems);
  const auto body = [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) results[i] = grind(static_cast<std::uint32_t>(i));
  };
  const auto serial = make_serial_executor();
  const auto alone = time_ns(kRepetitions, {}, [&] { serial->parallel_for(kItems, kGrain, body); });
  auto together = time_ns(kRepetitions, {}, [&] { pool.parallel_for(kItems, kGrain, body); });
  for (double& time : together) time *= pool.worker_count();
  return ratio_of(alone, together, hash_of(results));
}

/// 100 levels of 100 nodes; each node waits for two of the level above.
BenchValue run_graph_nodes(JobExecutor& executor) {
  constexpr std::uint32_t kLevels = 100;
  constexpr std::uint32_t kWidth = 100;
  std::vector<std::uint32_t> cells(kLevels * kWidth);
  std::vector<std::uint32_t> successors;
  std::vector<JobNode> nodes(cells.size());
  successors.reserve(cells.size() * 2);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t level = i / kWidth;
    const std::size_t first = successors.size();
    if (level + 1 < kLevels) {
      successors.push_back(i + kWidth);
      successors.push_back((level + 1) * kWidth + (i + 1) % kWidth);
    }
    nodes[i].work = [&cell = cells[i]] { ++cell; };
    nodes[i].successors = std::span(successors.data() + first, successors.size() - first);
    nodes[i].predecessor_count = level == 0 ? 0 : 2;
  }
  auto times = time_ns(kRepetitions, {}, [&] { executor.run_graph(nodes); });
  return per_item(std::move(times), static_cast<double>(nodes.size()), hash_of(cells));
}

/// A parallel_for with one tiny range a worker, over and over.
BenchValue run_fork_join(JobExecutor& executor) {
  constexpr int kForks = 1000;
  std::vector<std::uint32_t> cells(executor.worker_count());
  auto times = time_ns(kRepetitions, {}, [&] {
    for (int i = 0; i < kForks; ++i)
      executor.parallel_for(cells.size(), 1, [&](JobRange range) { ++cells[range.begin]; });
  });
  return per_item(std::move(times), kForks, hash_of(cells));
}

void add(BenchRegistry& registry, const char* id, const char* unit, Better better, BenchValue (*run)(JobExecutor&)) {
  registry.add(
      {.id = id, .unit = unit, .bar = {}, .better = better, .run = [run](BenchContext& context) -> Result<BenchValue> {
         const auto executor = make_pool_executor(context.options().threads);
         return run(*executor);
       }});
}

}  // namespace

void add_job_benches(BenchRegistry& registry) {
  add(registry, "jobs.empty", "ns/job", Better::lower, &run_empty_jobs);
  registry.add({.id = "jobs.empty.one_thread",
                .unit = "ns/job",
                .bar = {},
                .better = Better::lower,
                .run = [](BenchContext&) -> Result<BenchValue> { return run_empty_jobs(*make_pool_executor(1)); }});
  add(registry, "jobs.parallel_for_efficiency", "ratio", Better::higher, &run_parallel_for);
  add(registry, "jobs.graph_node", "ns/node", Better::lower, &run_graph_nodes);
  add(registry, "jobs.fork_join", "ns", Better::lower, &run_fork_join);
}

}  // namespace gloam
