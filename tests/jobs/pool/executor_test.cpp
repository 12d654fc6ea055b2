// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "engine/jobs/executor.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

using namespace std::chrono_literals;

/// A barrier that opens when `count` threads wait in it. attend() returns false if that takes longer than 20 s.
class Meeting {
 public:
  explicit Meeting(int count) : missing_(count) {}
  [[nodiscard]] bool attend() {
    std::unique_lock lock(mutex_);
    --missing_;
    changed_.notify_all();
    return changed_.wait_for(lock, 20s, [&] { return missing_ <= 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int missing_;
};

TEST(pool_executor, counts_its_threads) {
  EXPECT_EQ(make_pool_executor(1)->worker_count(), 1u);
  EXPECT_EQ(make_pool_executor(8)->worker_count(), 8u);
  EXPECT_GE(make_pool_executor()->worker_count(), 1u);
}

TEST(pool_executor, of_one_thread_stays_on_the_calling_thread) {
  const auto executor = make_pool_executor(1);
  std::set<std::thread::id> threads;
  executor->parallel_for(1000, 1, [&](JobRange) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(pool_executor, runs_two_jobs_of_a_batch_at_once) {
  const auto executor = make_pool_executor(2);
  Meeting meeting(2);
  std::atomic<int> met = 0;
  const std::vector<std::function<void()>> jobs(2, [&] { met += meeting.attend() ? 1 : 0; });
  executor->run(jobs);
  EXPECT_EQ(met.load(), 2);
}

TEST(pool_executor, runs_eight_jobs_at_once_even_on_fewer_cores) {
  const auto executor = make_pool_executor(8);
  Meeting meeting(8);
  std::atomic<int> met = 0;
  executor->parallel_for(8, 1, [&](JobRange) { met += meeting.attend() ? 1 : 0; });
  EXPECT_EQ(met.load(), 8);
}

TEST(pool_executor, runs_independent_nodes_at_once) {
  const auto executor = make_pool_executor(2);
  Meeting meeting(2);
  std::atomic<int> met = 0;
  std::vector<JobNode> nodes(2);
  for (JobNode& node : nodes) node.work = [&] { met += meeting.attend() ? 1 : 0; };
  executor->run_graph(nodes);
  EXPECT_EQ(met.load(), 2);
}

TEST(pool_executor, calls_helpers_when_short_jobs_of_a_site_turn_long) {
  const auto executor = make_pool_executor(2);
  std::set<std::thread::id> threads;
  std::mutex mutex;
  std::chrono::microseconds length = 0us;
  const std::function<void(JobRange)> body = [&](JobRange) {
    if (length == 0us) return;
    std::this_thread::sleep_for(length);
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  };
  for (int i = 0; i < 100; ++i) executor->parallel_for(4, 1, body);
  EXPECT_TRUE(threads.empty());
  length = 20ms;
  executor->parallel_for(40, 1, body);
  EXPECT_EQ(threads.size(), 2u);
}

TEST(pool_executor, lets_a_thread_that_waits_for_its_graph_help_inside_the_other_node) {
  // Node 0 ends at once. Node 1 needs a second thread inside its own parallel_for; the only other thread is the one
  // that waits for the graph.
  const auto executor = make_pool_executor(2);
  for (int round = 0; round < test::scaled(20); ++round) {
    Meeting meeting(2);
    std::atomic<int> met = 0;
    std::vector<JobNode> nodes(2);
    nodes[0].work = [] { std::this_thread::sleep_for(100us); };
    nodes[1].work = [&] { executor->parallel_for(2, 1, [&](JobRange) { met += meeting.attend() ? 1 : 0; }); };
    executor->run_graph(nodes);
    ASSERT_EQ(met.load(), 2);
  }
}

TEST(pool_executor, serves_several_callers_at_once) {
  const auto executor = make_pool_executor(2);
  std::atomic<std::size_t> sum = 0;
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] {
      for (int round = 0; round < test::scaled(200); ++round) {
        executor->parallel_for(100, 1, [&](JobRange range) {
          executor->parallel_for(4, 1, [&](JobRange) { sum.fetch_add(range.begin, std::memory_order_relaxed); });
        });
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum.load(), 4u * static_cast<std::size_t>(test::scaled(200)) * 4u * 4950u);
}

TEST(pool_executor, lives_beside_others_and_nests_in_them) {
  const auto two = make_pool_executor(2);
  const auto three = make_pool_executor(3);
  const auto eight = make_pool_executor(8);
  std::atomic<int> leaves = 0;
  two->parallel_for(6, 1, [&](JobRange) {
    eight->parallel_for(6, 1, [&](JobRange) { three->parallel_for(6, 1, [&](JobRange) { ++leaves; }); });
  });
  EXPECT_EQ(leaves.load(), 6 * 6 * 6);
}

TEST(pool_executor, can_be_made_used_and_dropped_again_and_again) {
  for (int round = 0; round < test::scaled(100); ++round) {
    const auto executor = make_pool_executor(2 + static_cast<std::uint32_t>(round) % 3);
    std::atomic<int> runs = 0;
    executor->parallel_for(50, 1, [&](JobRange) { ++runs; });
    ASSERT_EQ(runs.load(), 50);
  }
}

TEST(pool_executor, survives_bursts_with_pauses_in_which_helpers_leave) {
  const auto executor = make_pool_executor(2);
  for (int round = 0; round < test::scaled(100); ++round) {
    std::atomic<int> runs = 0;
    executor->parallel_for(20, 1, [&](JobRange) {
      const auto end = std::chrono::steady_clock::now() + 5us;
      while (std::chrono::steady_clock::now() < end) continue;
      ++runs;
    });
    ASSERT_EQ(runs.load(), 20);
    std::this_thread::sleep_for(std::chrono::microseconds(round * 7 % 200));
  }
}

}  // namespace
}  // namespace gloam
