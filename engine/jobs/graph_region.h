// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "engine/jobs/crew.h"
#include "engine/jobs/executor.h"
#include "engine/jobs/first_failure.h"

namespace gloam {

/// One run_graph. Each thread keeps the nodes it made ready on a stack of its own and goes on with the first ready
/// successor; half the stack goes to the shared queue when that is empty and the work is worth a helper.
/// A node that fails leaves out what waits for it, whatever the order; all else runs.
class GraphRegion final : public Region {
 public:
  /// Asserts that the graph is sound (see pending_counts). nodes must outlive the region.
  GraphRegion(std::span<JobNode> nodes, Crew& crew, float node_ns);
  ~GraphRegion() { crew_.close(*this); }

  /// Runs every node. Returns nanoseconds a node on this thread. Rethrows the exception of the lowest node that failed.
  float lead();

  [[nodiscard]] bool has_work() const override { return shared_count_.load(std::memory_order_acquire) > 0; }
  void help() override;

 private:
  /// What one thread holds.
  struct Lane {
    std::vector<std::uint32_t> ready;
    std::uint32_t done = 0;           ///< nodes not yet taken off remaining_
    std::uint32_t since_sample = 0;   ///< nodes since the clock was read
    std::uint32_t sample_period = 1;  ///< grows, so that short nodes do not pay for the clock
    Clock::time_point sampled_at = Clock::now();
  };
  void drain(Lane& lane);
  void run_chain(Lane& lane, std::uint32_t node);
  [[nodiscard]] bool run_node(std::uint32_t node);
  /// The successor to go on with, or kNone; others that became ready go to the lane.
  [[nodiscard]] std::uint32_t finish_node(Lane& lane, std::uint32_t node, bool succeeded);
  void sample(Lane& lane);
  void share(Lane& lane);
  [[nodiscard]] bool take_shared(Lane& lane);

  static constexpr std::uint32_t kNone = ~0u;
  std::span<JobNode> nodes_;
  Crew& crew_;
  std::vector<std::uint32_t> pending_;  ///< through atomic_ref while the graph runs
  FirstFailure failure_;
  std::atomic<float> node_ns_;
  std::mutex shared_mutex_;
  std::vector<std::uint32_t> shared_;
  std::atomic<std::size_t> shared_count_ = 0;
  std::atomic<std::size_t> remaining_;
};

}  // namespace gloam
