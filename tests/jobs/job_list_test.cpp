// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/job_list.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/jobs/executors.h"
#include "tests/support/expect_assert.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

class JobLists : public ::testing::TestWithParam<test::ExecutorCase> {
 protected:
  std::unique_ptr<JobExecutor> executor_ = GetParam().make();
  JobList list_;
};

INSTANTIATE_TEST_SUITE_P(All, JobLists, ::testing::ValuesIn(test::all_executors()),
                         [](const auto& test_case) { return test_case.param.name; });

/// Message of the exception that running the list throws; empty if it does not throw.
std::string thrown_by(JobList& list, JobExecutor& executor) {
  try {
    list.run(executor);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST_P(JobLists, run_each_job_once_and_are_empty_afterwards) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 1000u, 20'000u}) {
    std::vector<int> runs(count, 0);  // not atomic: ThreadSanitizer checks that run() orders the writes
    for (std::size_t i = 0; i < count; ++i) list_.add([&runs, i] { ++runs[i]; });
    EXPECT_EQ(list_.size(), count);
    list_.run(*executor_);
    EXPECT_EQ(runs, std::vector<int>(count, 1)) << count << " jobs";
    EXPECT_EQ(list_.size(), 0u);
    list_.run(*executor_);
    EXPECT_EQ(runs, std::vector<int>(count, 1)) << "an empty list runs nothing";
  }
}

TEST_P(JobLists, keep_jobs_of_different_types_and_sizes_apart) {
  std::vector<std::uint64_t> results(3000, 0);
  for (std::size_t i = 0; i < results.size(); i += 3) {
    list_.add([&result = results[i], i] { result = i; });
    std::array<std::uint64_t, 40> many{};
    many.fill(i);
    list_.add([&result = results[i + 1], many] {
      for (const std::uint64_t value : many) result += value;
    });
    struct alignas(64) Aligned {
      std::uint64_t value;
    };
    list_.add([&result = results[i + 2], aligned = Aligned{i}] {
      result = aligned.value + reinterpret_cast<std::uintptr_t>(&aligned) % alignof(Aligned);
    });
  }
  list_.run(*executor_);
  for (std::size_t i = 0; i < results.size(); i += 3) {
    ASSERT_EQ(results[i], i);
    ASSERT_EQ(results[i + 1], 40 * i);
    ASSERT_EQ(results[i + 2], i);
  }
}

TEST_P(JobLists, own_move_only_jobs_until_they_have_run) {
  const auto shared = std::make_shared<int>(0);
  std::atomic<int> sum = 0;
  for (int i = 0; i < 100; ++i)
    list_.add([&sum, shared, own = std::make_unique<int>(i)] { sum.fetch_add(*own, std::memory_order_relaxed); });
  EXPECT_EQ(shared.use_count(), 101);
  list_.run(*executor_);
  EXPECT_EQ(sum.load(), 4950);
  EXPECT_EQ(shared.use_count(), 1);
}

TEST_P(JobLists, rethrow_the_exception_of_the_lowest_job_and_can_be_used_again) {
  for (int round = 0; round < test::scaled(50); ++round) {
    const auto shared = std::make_shared<int>(0);
    for (std::size_t i = 0; i < 200; ++i) {
      list_.add([i, shared] {
        if (i == 20 || i == 21 || i == 90 || i == 199) throw std::runtime_error("job " + std::to_string(i));
      });
    }
    ASSERT_EQ(thrown_by(list_, *executor_), "job 20");
    ASSERT_EQ(list_.size(), 0u);
    ASSERT_EQ(shared.use_count(), 1) << "jobs that did not run are destroyed too";
  }
}

TEST_P(JobLists, let_started_jobs_end_before_they_rethrow) {
  std::atomic<int> inside = 0;
  for (int i = 0; i < 40; ++i) {
    list_.add([&inside, i] {
      ++inside;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      --inside;
      if (i == 5) throw std::runtime_error("five");
    });
  }
  EXPECT_EQ(thrown_by(list_, *executor_), "five");
  EXPECT_EQ(inside.load(), 0);
}

TEST_P(JobLists, nest_in_each_other) {
  std::atomic<int> leaves = 0;
  for (int i = 0; i < 8; ++i) {
    list_.add([&] {
      JobList inner;
      for (int j = 0; j < 50; ++j) inner.add([&leaves] { leaves.fetch_add(1, std::memory_order_relaxed); });
      inner.run(*executor_);
    });
  }
  list_.run(*executor_);
  EXPECT_EQ(leaves.load(), 8 * 50);
}

TEST(job_list, clear_destroys_jobs_without_running_them) {
  JobList list;
  const auto shared = std::make_shared<int>(0);
  int runs = 0;
  for (int i = 0; i < 10; ++i) list.add([&runs, shared] { ++runs; });
  list.clear();
  list.run(*make_serial_executor());
  EXPECT_EQ(runs, 0);
  EXPECT_EQ(shared.use_count(), 1);
}

TEST(job_list, refuses_changes_by_its_own_jobs) {
  const auto serial = make_serial_executor();
  JobList list;
  list.add([&list] { list.add([] {}); });
  EXPECT_ASSERT(list.run(*serial), "must not be changed by its own jobs");
  list.add([&list, &serial] { list.run(*serial); });
  EXPECT_ASSERT(list.run(*serial), "must not be changed by its own jobs");
}

TEST(job_list, on_a_pool_runs_jobs_on_several_threads) {
  const auto pool = make_pool_executor(2);
  JobList list;
  std::atomic<int> inside = 0;
  std::atomic<bool> met = false;
  for (int i = 0; i < 2; ++i) {
    list.add([&] {
      ++inside;
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (inside.load() < 2 && !met.load() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
      if (inside.load() == 2) met = true;
      while (!met.load() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
      --inside;
    });
  }
  list.run(*pool);
  EXPECT_TRUE(met.load());
}

}  // namespace
}  // namespace gloam
