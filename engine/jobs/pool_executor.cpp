// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/jobs/crew.h"
#include "engine/jobs/executor.h"
#include "engine/jobs/graph_region.h"
#include "engine/jobs/job_graph.h"
#include "engine/jobs/range_region.h"
#include "engine/jobs/site_costs.h"

namespace gloam {
namespace {

class PoolExecutor final : public JobExecutor {
 public:
  explicit PoolExecutor(std::uint32_t threads) : crew_(threads) {}

  [[nodiscard]] std::uint32_t worker_count() const override { return crew_.threads(); }

  void run(std::span<const std::function<void()>> jobs) override {
    if (jobs.size() <= 1 || crew_.threads() == 1) {
      for (const auto& job : jobs) job();
      return;
    }
    const std::function<void(JobRange)> body = [jobs](JobRange range) { jobs[range.begin](); };
    lead_ranges(jobs.size(), 1, body, SiteCosts::site(jobs.front().target_type(), 0));
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override {
    const std::size_t ranges = range_count(count, grain);
    if (ranges <= 1 || crew_.threads() == 1) {
      for (std::size_t i = 0; i < ranges; ++i) body(job_range(i, count, grain));
      return;
    }
    lead_ranges(count, grain, body, SiteCosts::site(body.target_type(), 0));
  }

  void run_graph(std::span<JobNode> nodes) override {
    if (nodes.empty()) return;
    const SiteCosts::Site site = SiteCosts::site(nodes.front().work.target_type(), nodes.size());
    GraphRegion region(nodes, crew_, costs_.recall(site));
    costs_.learn(site, region.lead());
  }

 private:
  void lead_ranges(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body,
                   SiteCosts::Site site) {
    const auto items_a_range = static_cast<float>(std::min(count, grain));
    RangeRegion region(count, grain, body, crew_);
    const float range_ns = region.lead(costs_.recall(site) * items_a_range);
    if (range_ns > 0.0f) costs_.learn(site, range_ns / items_a_range);
  }

  Crew crew_;
  SiteCosts costs_;
};

}  // namespace

std::unique_ptr<JobExecutor> make_pool_executor(std::uint32_t threads) {
  return std::make_unique<PoolExecutor>(threads == 0 ? Crew::core_count() : threads);
}

}  // namespace gloam
