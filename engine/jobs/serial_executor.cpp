// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/executor.h"
#include "engine/jobs/first_failure.h"
#include "engine/jobs/job_graph.h"

namespace gloam {
namespace {

class SerialExecutor final : public JobExecutor {
 public:
  [[nodiscard]] std::uint32_t worker_count() const override { return 1; }

  void run(std::span<const std::function<void()>> jobs) override {
    for (const auto& job : jobs) job();
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override {
    const std::size_t ranges = range_count(count, grain);
    for (std::size_t i = 0; i < ranges; ++i) body(job_range(i, count, grain));
  }

  void run_graph(std::span<JobNode> nodes) override {
    // Edges lead forward, so index order is a legal order.
    std::vector<std::uint32_t> pending = pending_counts(nodes);
    FirstFailure failure;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      bool run = (pending[i] & kSkipNode) == 0;
      if (run) {
        try {
          nodes[i].work();
        } catch (...) {
          failure.record(i, std::current_exception());
          run = false;
        }
      }
      if (run) continue;
      for (const std::uint32_t successor : nodes[i].successors) pending[successor] |= kSkipNode;
    }
    failure.rethrow_if_any();
  }
};

}  // namespace

std::unique_ptr<JobExecutor> make_serial_executor() { return std::make_unique<SerialExecutor>(); }

}  // namespace gloam
