// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <atomic>
#include <numeric>
#include <utility>

#include "engine/jobs/executor.h"
#include "engine/jobs/first_failure.h"
#include "engine/jobs/job_graph.h"

namespace gloam {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same sequence on every platform, unlike the distributions of <random>.
/// Several threads may draw numbers at once.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// In [0, bound); bound ≥ 1. The bias of the remainder does not matter for orders of jobs.
  [[nodiscard]] std::size_t below(std::size_t bound) {
    constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_.fetch_add(kStep, std::memory_order_relaxed) + kStep;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<std::size_t>((z ^ (z >> 31)) % bound);
  }

 private:
  std::atomic<std::uint64_t> state_;
};

class ShuffledExecutor final : public JobExecutor {
 public:
  explicit ShuffledExecutor(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::uint32_t worker_count() const override { return 1; }

  void run(std::span<const std::function<void()>> jobs) override {
    run_shuffled(jobs.size(), [&](std::size_t i) { jobs[i](); });
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(JobRange)>& body) override {
    run_shuffled(range_count(count, grain), [&](std::size_t i) { body(job_range(i, count, grain)); });
  }

  void run_graph(std::span<JobNode> nodes) override {
    std::vector<std::uint32_t> pending = pending_counts(nodes);
    std::vector<std::uint32_t> ready;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      if (pending[i] == 0) ready.push_back(i);
    }
    FirstFailure failure;
    while (!ready.empty()) {
      std::swap(ready[random_.below(ready.size())], ready.back());
      const std::uint32_t i = ready.back();
      ready.pop_back();
      bool skip = (pending[i] & kSkipNode) != 0;
      if (!skip) skip = !attempt(failure, i, [&] { nodes[i].work(); });
      for (const std::uint32_t successor : nodes[i].successors) {
        if (skip) pending[successor] |= kSkipNode;
        --pending[successor];
        if ((pending[successor] & ~kSkipNode) == 0) ready.push_back(successor);
      }
    }
    failure.rethrow_if_any();
  }

 private:
  template <class Job>
  static bool attempt(FirstFailure& failure, std::size_t index, const Job& job) {
    try {
      job();
      return true;
    } catch (...) {
      failure.record(index, std::current_exception());
      return false;
    }
  }

  template <class Job>
  void run_shuffled(std::size_t count, const Job& job) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    FirstFailure failure;
    for (std::size_t left = count; left > 0; --left) {
      std::swap(order[random_.below(left)], order[left - 1]);
      const std::size_t index = order[left - 1];
      if (index < failure.index()) attempt(failure, index, [&] { job(index); });
    }
    failure.rethrow_if_any();
  }

  Random random_;
};

}  // namespace

std::unique_ptr<JobExecutor> make_shuffled_executor(std::uint64_t seed) {
  return std::make_unique<ShuffledExecutor>(seed);
}

}  // namespace gloam
