// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>
#include <vector>

#include "engine/jobs/executor.h"

namespace gloam {
namespace {

std::vector<std::size_t> order_of_ranges(JobExecutor& executor, std::size_t count) {
  std::vector<std::size_t> order;
  executor.parallel_for(count, 1, [&](JobRange range) { order.push_back(range.ordinal); });
  return order;
}

TEST(serial_executor, runs_in_index_order) {
  const auto order = order_of_ranges(*make_serial_executor(), 100);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(shuffled_executor, draws_its_order_from_the_seed_alone) {
  EXPECT_EQ(order_of_ranges(*make_shuffled_executor(3), 50), order_of_ranges(*make_shuffled_executor(3), 50));
  EXPECT_NE(order_of_ranges(*make_shuffled_executor(3), 50), order_of_ranges(*make_shuffled_executor(4), 50));
}

TEST(shuffled_executor, reaches_every_order_of_three_jobs) {
  std::set<std::vector<std::size_t>> orders;
  for (std::uint64_t seed = 0; seed < 200; ++seed) orders.insert(order_of_ranges(*make_shuffled_executor(seed), 3));
  EXPECT_EQ(orders.size(), 6u);
}

TEST(shuffled_executor, reaches_every_legal_order_of_a_graph) {
  // One edge 0 → 2; node 1 is free. The legal orders are 012, 021 and 102.
  std::set<std::vector<int>> orders;
  const std::uint32_t two[] = {2};
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::vector<int> order;
    std::vector<JobNode> nodes(3);
    for (int i = 0; i < 3; ++i) nodes[static_cast<std::size_t>(i)].work = [&order, i] { order.push_back(i); };
    nodes[0].successors = two;
    nodes[2].predecessor_count = 1;
    make_shuffled_executor(seed)->run_graph(nodes);
    orders.insert(order);
  }
  EXPECT_EQ(orders, (std::set<std::vector<int>>{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}}));
}

TEST(shuffled_executor, stays_on_the_calling_thread) {
  std::set<std::thread::id> threads;
  const auto executor = make_shuffled_executor(1);
  executor->parallel_for(100, 1, [&](JobRange) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

}  // namespace
}  // namespace gloam
