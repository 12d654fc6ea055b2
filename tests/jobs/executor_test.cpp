// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/jobs/executors.h"
#include "tests/support/expect_assert.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

class Executor : public ::testing::TestWithParam<test::ExecutorCase> {
 protected:
  std::unique_ptr<JobExecutor> executor_ = GetParam().make();
};

INSTANTIATE_TEST_SUITE_P(All, Executor, ::testing::ValuesIn(test::all_executors()),
                         [](const auto& test_case) { return test_case.param.name; });

/// Message of the exception that a call throws; empty if it does not throw.
template <class Call>
std::string thrown_by(Call&& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST_P(Executor, states_at_least_one_worker) { EXPECT_GE(executor_->worker_count(), 1u); }

TEST_P(Executor, runs_each_job_of_a_batch_once) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 17u, 1000u}) {
    std::vector<int> runs(count, 0);
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < count; ++i) jobs.emplace_back([&runs, i] { ++runs[i]; });
    executor_->run(jobs);
    EXPECT_EQ(runs, std::vector<int>(count, 1)) << count << " jobs";
  }
}

TEST_P(Executor, runs_a_million_jobs) {
  std::atomic<std::size_t> runs = 0;
  const std::vector<std::function<void()>> jobs(static_cast<std::size_t>(test::scaled(1'000'000)),
                                                [&] { runs.fetch_add(1, std::memory_order_relaxed); });
  executor_->run(jobs);
  EXPECT_EQ(runs.load(), jobs.size());
}

TEST_P(Executor, covers_every_index_once_with_ordinals_from_the_front) {
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 100'000u}) {
    for (const std::size_t grain : {1u, 7u, 64u, 1'000'000u}) {
      std::vector<std::uint8_t> visits(count, 0);
      std::vector<JobRange> ranges((count + grain - 1) / grain);
      executor_->parallel_for(count, grain, [&](JobRange range) {
        ranges.at(range.ordinal) = range;
        for (std::size_t i = range.begin; i < range.end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<std::uint8_t>(count, 1)) << count << " by " << grain;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        wrong += ranges[i].begin != i * grain || ranges[i].end != std::min(count, (i + 1) * grain) ? 1u : 0u;
      }
      EXPECT_EQ(wrong, 0u) << count << " by " << grain;
    }
  }
}

TEST_P(Executor, refuses_a_grain_of_zero) {
  EXPECT_ASSERT(executor_->parallel_for(10, 0, [](JobRange) {}), "grain");
}

TEST_P(Executor, sees_what_jobs_wrote_when_the_call_returns) {
  // Plain writes: ThreadSanitizer checks that the return of parallel_for orders them.
  std::vector<std::size_t> values(10'000, 0);
  for (std::size_t round = 1; round <= static_cast<std::size_t>(test::scaled(200)); ++round) {
    executor_->parallel_for(values.size(), 100, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) values[i] += i;
    });
    ASSERT_EQ(std::accumulate(values.begin(), values.end(), std::size_t{0}), round * 49'995'000u);
  }
}

TEST_P(Executor, nests_three_deep) {
  for (int round = 0; round < test::scaled(20); ++round) {
    std::atomic<int> leaves = 0;
    executor_->parallel_for(8, 1, [&](JobRange) {
      executor_->parallel_for(8, 1, [&](JobRange) {
        executor_->parallel_for(32, 2, [&](JobRange range) {
          leaves.fetch_add(static_cast<int>(range.end - range.begin), std::memory_order_relaxed);
        });
      });
    });
    ASSERT_EQ(leaves.load(), 8 * 8 * 32);
  }
}

TEST_P(Executor, nests_three_deep_with_work_long_enough_to_share) {
  std::atomic<int> leaves = 0;
  const auto work = [&](JobRange) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
    while (std::chrono::steady_clock::now() < end) leaves.fetch_add(0, std::memory_order_relaxed);
    leaves.fetch_add(1, std::memory_order_relaxed);
  };
  for (int round = 0; round < test::scaled(10); ++round) {
    executor_->parallel_for(
        4, 1, [&](JobRange) { executor_->parallel_for(4, 1, [&](JobRange) { executor_->parallel_for(8, 1, work); }); });
  }
  EXPECT_EQ(leaves.load(), test::scaled(10) * 4 * 4 * 8);
}

TEST_P(Executor, mixes_batches_ranges_and_graphs_inside_each_other) {
  std::atomic<int> leaves = 0;
  const std::vector<std::function<void()>> jobs(
      6, [&] { executor_->parallel_for(10, 3, [&](JobRange r) { leaves += static_cast<int>(r.end - r.begin); }); });
  const std::uint32_t both[] = {1, 2};
  std::vector<JobNode> nodes(3);
  for (JobNode& node : nodes) node.work = [&] { executor_->run(jobs); };
  nodes[0].successors = both;
  nodes[1].predecessor_count = nodes[2].predecessor_count = 1;
  executor_->run_graph(nodes);
  EXPECT_EQ(leaves.load(), 3 * 6 * 10);
}

TEST_P(Executor, rethrows_the_exception_of_the_lowest_job) {
  for (int round = 0; round < test::scaled(50); ++round) {
    std::vector<std::function<void()>> jobs(200, [] {});
    for (const std::size_t bad : {20u, 21u, 90u, 199u}) {
      jobs[bad] = [bad] { throw std::runtime_error("job " + std::to_string(bad)); };
    }
    ASSERT_EQ(thrown_by([&] { executor_->run(jobs); }), "job 20");
    const auto body = [](JobRange range) {
      if (range.ordinal >= 3) throw std::runtime_error("range " + std::to_string(range.ordinal));
    };
    ASSERT_EQ(thrown_by([&] { executor_->parallel_for(1000, 10, body); }), "range 3");
  }
}

TEST_P(Executor, lets_started_jobs_end_before_it_rethrows) {
  std::atomic<int> inside = 0;
  const auto body = [&](JobRange range) {
    ++inside;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    --inside;
    if (range.ordinal == 5) throw std::runtime_error("five");
  };
  EXPECT_EQ(thrown_by([&] { executor_->parallel_for(40, 1, body); }), "five");
  EXPECT_EQ(inside.load(), 0);
}

TEST_P(Executor, works_on_after_an_exception_and_passes_one_through_nested_calls) {
  const auto inner = [](JobRange range) {
    if (range.ordinal == 2) throw std::runtime_error("deep");
  };
  EXPECT_EQ(thrown_by([&] { executor_->parallel_for(6, 1, [&](JobRange) { executor_->parallel_for(6, 1, inner); }); }),
            "deep");
  std::atomic<int> runs = 0;
  executor_->parallel_for(100, 1, [&](JobRange) { ++runs; });
  EXPECT_EQ(runs.load(), 100);
}

}  // namespace
}  // namespace gloam
