// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/jobs/executor.h"
#include "engine/jobs/job_graph.h"
#include "engine/jobs/pool/crew.h"
#include "engine/jobs/pool/graph_region.h"
#include "engine/jobs/pool/range_region.h"
#include "engine/jobs/pool/site_costs.h"

namespace gloam {
namespace {

class Batch final : public RangeWork {
 public:
  explicit Batch(std::span<const std::function<void()>> jobs) : jobs_(jobs) {}
  void run(std::size_t& i, std::size_t end) const override {
    for (; i < end; ++i) jobs_[i]();
  }

 private:
  std::span<const std::function<void()>> jobs_;
};

class Loop final : public RangeWork {
 public:
  Loop(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body)
      : count_(count), grain_(grain), body_(body) {}
  void run(std::size_t& i, std::size_t end) const override {
    for (; i < end; ++i) body_(job_range(i, count_, grain_));
  }

 private:
  std::size_t count_;
  std::size_t grain_;
  const std::function<void(JobRange)>& body_;
};

class PoolExecutor final : public JobExecutor {
 public:
  explicit PoolExecutor(std::uint32_t threads) : crew_(threads) {}

  [[nodiscard]] std::uint32_t worker_count() const override { return crew_.threads(); }

  void run(std::span<const std::function<void()>> jobs) override {
    if (jobs.empty()) return;
    lead_ranges(jobs.size(), Batch(jobs), 1, jobs.front().target_type());
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override {
    lead_ranges(range_count(count, grain), Loop(count, grain, body), std::min(count, grain), body.target_type());
  }

  void run_graph(std::span<JobNode> nodes) override {
    if (nodes.empty()) return;
    const SiteCosts::Site site = SiteCosts::site(nodes.front().work.target_type(), nodes.size());
    GraphRegion region(nodes, crew_, costs_.recall(site));
    costs_.learn(site, region.lead());
  }

 private:
  /// items: per range. Costs are remembered per item, because a site's grain may change.
  void lead_ranges(std::size_t ranges, const RangeWork& work, std::size_t items, const std::type_info& type) {
    if (ranges <= 1 || crew_.threads() == 1) {
      std::size_t i = 0;
      work.run(i, ranges);
      return;
    }
    const SiteCosts::Site site = SiteCosts::site(type, 0);
    RangeRegion region(ranges, work, crew_);
    const float range_ns = region.lead(costs_.recall(site) * static_cast<float>(items));
    if (range_ns > 0.0f) costs_.learn(site, range_ns / static_cast<float>(items));
  }

  Crew crew_;
  SiteCosts costs_;
};

}  // namespace

std::unique_ptr<JobExecutor> make_pool_executor(std::uint32_t threads) {
  return std::make_unique<PoolExecutor>(threads == 0 ? Crew::core_count() : threads);
}

}  // namespace gloam
