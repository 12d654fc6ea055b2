// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace gloam {

/// A half-open range of indices handed to one call of a parallel_for body. `ordinal` counts ranges from the front, so
/// that a body can write a slice of its own and a later merge by ordinal does not depend on the order of execution.
struct JobRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t ordinal = 0;
};

/// One node of a graph: `successors` index into the same span and must lie behind it in no particular order; no cycles.
struct JobNode {
  std::function<void()> work;
  std::span<const std::uint32_t> successors;
  std::uint32_t predecessor_count = 0;
};

/// Runs jobs. All calls block until their work is done, may be nested from inside jobs, and rethrow the first exception
/// of a job (in order of job index) after every started job has ended. Results must not depend on which thread runs
/// what.
class JobExecutor {
 public:
  virtual ~JobExecutor() = default;

  /// Threads that can run jobs at once, the caller's included; ≥ 1.
  [[nodiscard]] virtual std::uint32_t worker_count() const = 0;

  /// Runs all jobs of a batch, in any order.
  virtual void run(std::span<const std::function<void()>> jobs) = 0;

  /// Splits [0, count) into ceil(count / grain) ranges whose ordinals are begin / grain. grain ≥ 1; count may be 0.
  virtual void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) = 0;

  /// Runs every node after its predecessors.
  virtual void run_graph(std::span<JobNode> nodes) = 0;
};

/// Everything on the calling thread, in index order.
[[nodiscard]] std::unique_ptr<JobExecutor> make_serial_executor();

/// Everything on the calling thread, in a random legal order drawn from `seed`: for tests.
[[nodiscard]] std::unique_ptr<JobExecutor> make_shuffled_executor(std::uint64_t seed);

/// Threads from oneTBB. threads = 0: one a core. threads = 1 spawns none.
[[nodiscard]] std::unique_ptr<JobExecutor> make_pool_executor(std::uint32_t threads = 0);

}  // namespace gloam
