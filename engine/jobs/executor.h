// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace gloam {

/// A half-open range of indices, the argument of one call of a parallel_for body. `ordinal` numbers the ranges from the
/// front, so that each call can write to its own slot and a later merge by ordinal does not depend on the order of
/// execution.
struct JobRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t ordinal = 0;
};

/// One node of a job graph. `successors`: indices into the same span, each greater than the node's own index (so there
/// are no cycles), in any order. `predecessor_count`: the number of edges that end at this node.
struct JobNode {
  std::function<void()> work;
  std::span<const std::uint32_t> successors;
  std::uint32_t predecessor_count = 0;
};

/// Runs jobs. Every call blocks until its work is done and may be nested inside a job. If jobs throw, the call rethrows
/// the exception of the job with the lowest index after every started job has ended. Results must not depend on which
/// thread runs which job.
class JobExecutor {
 public:
  virtual ~JobExecutor() = default;

  /// Number of threads that can run jobs at once, including the caller's; ≥ 1.
  [[nodiscard]] virtual std::uint32_t worker_count() const = 0;

  /// Runs all jobs of a batch, in any order.
  virtual void run(std::span<const std::function<void()>> jobs) = 0;

  /// Calls `body` once for each of ceil(count / grain) ranges of [0, count), in any order. The ordinal of a range is
  /// begin / grain. grain ≥ 1; count may be 0.
  virtual void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) = 0;

  /// Runs every node after its predecessors. Nodes that depend on a failed node, directly or not, are skipped; all
  /// others run. Asserts that the graph is valid (see pending_counts).
  virtual void run_graph(std::span<JobNode> nodes) = 0;
};

/// Runs everything on the calling thread, in index order.
[[nodiscard]] std::unique_ptr<JobExecutor> make_serial_executor();

/// Runs everything on the calling thread, in a random legal order drawn from `seed`: for tests.
[[nodiscard]] std::unique_ptr<JobExecutor> make_shuffled_executor(std::uint64_t seed);

/// Runs jobs on oneTBB's threads. `threads` includes the caller's; 0: one per core; 1: no other thread is used.
[[nodiscard]] std::unique_ptr<JobExecutor> make_pool_executor(std::uint32_t threads = 0);

}  // namespace gloam
