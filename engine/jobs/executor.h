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
/// are no cycles), in any order; the same index may occur several times. `predecessor_count`: the number of edges that
/// end at this node. run_graph changes no node, so the same nodes can be run again.
struct JobNode {
  std::function<void()> work;
  std::span<const std::uint32_t> successors;
  std::uint32_t predecessor_count = 0;
};

/// Runs jobs. A job is a function of a batch, one call of a parallel_for body, or the work of a node. A host implements
/// this interface on its own threads; executor_faults (engine/jobs/executor_conformance.h) checks the rules below.
///
/// **Calls.** Every call blocks until all of its jobs have ended. Calls come from any thread, also from threads that
/// the executor does not know and from several threads at once. A call without jobs returns at once.
///
/// **Threads.** A job runs on the calling thread or on any other one. No thread need exist beside the caller's, so a
/// job must not wait for another job to start or to end. Results must not depend on the thread or the order of jobs.
///
/// **Nesting.** A job may make any call of its executor, or of another one, to any depth. While a call waits, its
/// thread may run other jobs, so a job must not hold a lock across a call.
///
/// **Order.** Jobs of a batch and ranges of a loop run in any order and at once. A node starts after its predecessors
/// have ended; nodes without a path between them, such as the successors of one node, run in any order and at once.
///
/// **Memory.** A job sees all that the calling thread wrote before the call. A node sees all that its predecessors
/// wrote, and theirs. The caller sees all that the jobs wrote when the call returns or throws. Nothing else is ordered.
///
/// **Failure.** A job fails if an exception leaves it, of any type. An empty std::function fails with
/// std::bad_function_call. The call waits for the jobs that have started and then rethrows the exception of the failed
/// job with the lowest index (JobRange::ordinal in a loop), so that the exception does not depend on timing:
/// - batch and loop: every job below the lowest failed one has run; each job above it has run once or not at all.
/// - graph: nodes that depend on a failed node, directly or not, have not run; all other nodes have.
///
/// Only the call whose job failed throws. A job that makes a call fails with the exception of that call, unless it
/// catches it. The executor keeps nothing of a failure: calls that run at the same time and later calls are not
/// affected.
///
/// **Lifetime.** No call may be running when the executor is destroyed. Spans and functions that are passed to a call
/// are not used after it has ended.
class JobExecutor {
 public:
  virtual ~JobExecutor() = default;

  /// Number of threads that can run jobs at once, including the caller's; ≥ 1, and always the same.
  [[nodiscard]] virtual std::uint32_t worker_count() const = 0;

  /// Runs each job of a batch once.
  virtual void run(std::span<const std::function<void()>> jobs) = 0;

  /// Calls `body` once for each of ceil(count / grain) ranges of [0, count), possibly from several threads at once. The
  /// ordinal of a range is begin / grain; its length is grain, or less for the last one. A grain above count gives one
  /// range [0, count). count may be 0. grain ≥ 1, asserted (range_count and job_range of engine/jobs/job_graph.h do all
  /// of this without overflow).
  virtual void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) = 0;

  /// Runs each node once, after its predecessors. Asserts that the graph is valid (pending_counts of
  /// engine/jobs/job_graph.h).
  virtual void run_graph(std::span<JobNode> nodes) = 0;
};

/// Runs everything on the calling thread, in index order.
[[nodiscard]] std::unique_ptr<JobExecutor> make_serial_executor();

/// Runs everything on the calling thread, in a random legal order drawn from `seed`: for tests.
[[nodiscard]] std::unique_ptr<JobExecutor> make_shuffled_executor(std::uint64_t seed);

/// Runs jobs on oneTBB's threads. `threads` includes the caller's; 0: one per core; 1: no other thread is used. Where
/// the system does not give the process as many threads, worker_count() is smaller.
[[nodiscard]] std::unique_ptr<JobExecutor> make_pool_executor(std::uint32_t threads = 0);

}  // namespace gloam
