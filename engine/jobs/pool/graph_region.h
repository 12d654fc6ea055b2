// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/jobs/first_failure.h"
#include "engine/jobs/pool/crew.h"

namespace gloam {

/// One run_graph call. Each thread keeps the nodes that it made ready on its own stack and continues with the first
/// ready successor. If the shared queue is empty and the ready nodes are worth a helper, half the stack moves there. If
/// a node fails, all nodes that depend on it are skipped, in every order of execution; all others run.
class GraphRegion final : public Region {
 public:
  /// Asserts that the graph is valid (see pending_counts). nodes must outlive the region. node_ns: the expected cost of
  /// a node, in nanoseconds.
  GraphRegion(std::span<JobNode> nodes, Crew& crew, float node_ns);
  ~GraphRegion() { crew_.close(*this); }

  /// Runs every node. Returns the measured nanoseconds per node, averaged over the threads. Rethrows the exception of
  /// the failed node with the lowest index.
  float lead();

  [[nodiscard]] bool has_work() const override { return shared_count_.load(std::memory_order_acquire) > 0; }
  void help() override;

 private:
  /// State of one thread that runs nodes.
  struct Lane {
    std::vector<std::uint32_t> ready;
    std::uint32_t done = 0;           ///< nodes run, but not yet subtracted from remaining_
    std::uint32_t since_sample = 0;   ///< nodes run since the clock was read
    std::uint32_t sample_period = 1;  ///< nodes per clock reading; grows, so that short nodes rarely read the clock
    Clock::time_point sampled_at = Clock::now();
  };
  void drain(Lane& lane);
  void run_chain(Lane& lane, std::uint32_t node);
  [[nodiscard]] bool run_node(std::uint32_t node);
  /// Returns the successor to run next, or kNone; other successors that became ready go to the lane.
  [[nodiscard]] std::uint32_t finish_node(Lane& lane, std::uint32_t node, bool succeeded);
  void sample(Lane& lane);
  void share(Lane& lane);
  [[nodiscard]] bool take_shared(Lane& lane);

  static constexpr std::uint32_t kNone = ~0u;
  std::span<JobNode> nodes_;
  Crew& crew_;
  std::vector<std::uint32_t> pending_;  ///< accessed through atomic_ref while the graph runs
  FirstFailure failure_;
  std::atomic<float> node_ns_;
  std::mutex shared_mutex_;
  std::vector<std::uint32_t> shared_;
  std::atomic<std::size_t> shared_count_ = 0;
  std::atomic<std::size_t> remaining_;
};

}  // namespace gloam
