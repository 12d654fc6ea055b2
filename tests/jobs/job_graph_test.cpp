// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/job_graph.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/jobs/executors.h"
#include "tests/support/expect_assert.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

/// A job graph that owns the successor lists of its nodes.
struct Graph {
  explicit Graph(std::size_t count) : successors(count), nodes(count) {}
  void edge(std::uint32_t from, std::uint32_t to) {
    successors[from].push_back(to);
    ++nodes[to].predecessor_count;
  }
  std::span<JobNode> finish() {
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].successors = successors[i];
    return nodes;
  }
  std::vector<std::vector<std::uint32_t>> successors;
  std::vector<JobNode> nodes;
};

class JobGraph : public ::testing::TestWithParam<test::ExecutorCase> {
 protected:
  std::unique_ptr<JobExecutor> executor_ = GetParam().make();
};

INSTANTIATE_TEST_SUITE_P(All, JobGraph, ::testing::ValuesIn(test::all_executors()),
                         [](const auto& test_case) { return test_case.param.name; });

TEST_P(JobGraph, may_be_empty) { executor_->run_graph({}); }

TEST_P(JobGraph, runs_a_chain_in_order) {
  constexpr std::uint32_t kLength = 1000;
  Graph graph(kLength);
  std::vector<std::uint32_t> order;  // not atomic: the edges alone must order the writes
  for (std::uint32_t i = 0; i < kLength; ++i) {
    graph.nodes[i].work = [&order, i] { order.push_back(i); };
    if (i > 0) graph.edge(i - 1, i);
  }
  executor_->run_graph(graph.finish());
  ASSERT_EQ(order.size(), kLength);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST_P(JobGraph, runs_each_node_of_a_random_graph_once_and_after_its_predecessors) {
  std::mt19937 random(11);
  for (int round = 0; round < test::scaled(60); ++round) {
    const std::uint32_t count = 1 + static_cast<std::uint32_t>(random()) % 300;
    Graph graph(count);
    std::vector<std::vector<std::uint32_t>> predecessors(count);
    std::vector<int> runs(count, 0);
    std::atomic<int> too_early = 0;
    for (std::uint32_t to = 0; to < count; ++to) {
      for (std::uint32_t n = static_cast<std::uint32_t>(random()) % 4; to > 0 && n > 0; --n) {
        predecessors[to].push_back(static_cast<std::uint32_t>(random()) % to);  // duplicates are legal
        graph.edge(predecessors[to].back(), to);
      }
      graph.nodes[to].work = [&, to] {
        for (const std::uint32_t from : predecessors[to]) too_early += runs[from] == 1 ? 0 : 1;
        ++runs[to];
      };
    }
    for (int repeat = 0; repeat < 3; ++repeat) {
      std::fill(runs.begin(), runs.end(), 0);
      executor_->run_graph(graph.finish());
      ASSERT_EQ(runs, std::vector<int>(count, 1));
      ASSERT_EQ(too_early.load(), 0);
    }
  }
}

TEST_P(JobGraph, runs_a_wide_graph) {
  const auto leaves = static_cast<std::uint32_t>(test::scaled(100'000));
  Graph graph(leaves + 2);
  std::atomic<std::uint32_t> runs = 0;
  for (JobNode& node : graph.nodes) node.work = [&] { runs.fetch_add(1, std::memory_order_relaxed); };
  for (std::uint32_t i = 1; i <= leaves; ++i) {
    graph.edge(0, i);
    graph.edge(i, leaves + 1);
  }
  executor_->run_graph(graph.finish());
  EXPECT_EQ(runs.load(), leaves + 2);
}

TEST_P(JobGraph, leaves_out_what_waits_for_a_failed_node_and_runs_the_rest) {
  // Edges: 0 → 1 → 2, 3 → 4, 4 → 6, 5 → 6. Nodes 1 and 4 fail.
  for (int round = 0; round < test::scaled(50); ++round) {
    Graph graph(7);
    std::vector<int> runs(7, 0);
    for (std::uint32_t i = 0; i < 7; ++i) {
      graph.nodes[i].work = [&runs, i] {
        ++runs[i];
        if (i == 1 || i == 4) throw std::runtime_error("node " + std::to_string(i));
      };
    }
    graph.edge(0, 1);
    graph.edge(1, 2);
    graph.edge(3, 4);
    graph.edge(4, 6);
    graph.edge(5, 6);
    std::string message;
    try {
      executor_->run_graph(graph.finish());
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    ASSERT_EQ(message, "node 1");
    ASSERT_EQ(runs, (std::vector<int>{1, 1, 0, 1, 1, 1, 0}));
  }
}

TEST_P(JobGraph, refuses_a_cycle) {
  Graph graph(3);
  for (JobNode& node : graph.nodes) node.work = [] {};
  graph.edge(0, 1);
  graph.edge(1, 2);
  graph.edge(2, 1);
  EXPECT_ASSERT(executor_->run_graph(graph.finish()), "node 2 of a job graph names successor 1");
}

TEST_P(JobGraph, refuses_an_edge_to_nowhere_and_a_wrong_predecessor_count) {
  Graph graph(2);
  for (JobNode& node : graph.nodes) node.work = [] {};
  graph.edge(0, 1);
  ++graph.nodes[1].predecessor_count;
  EXPECT_ASSERT(executor_->run_graph(graph.finish()), "states 2 predecessors, but 1 edges end there");
  graph.successors[0].push_back(9);
  EXPECT_ASSERT(executor_->run_graph(graph.finish()), "the graph has only 2 nodes");
}

TEST(job_range, splits_without_overflow_at_the_end_of_the_number_range) {
  EXPECT_EQ(range_count(SIZE_MAX, 2), SIZE_MAX / 2 + 1);
  const JobRange last = job_range(SIZE_MAX / 2, SIZE_MAX, 2);
  EXPECT_EQ(last.begin, SIZE_MAX - 1);
  EXPECT_EQ(last.end, SIZE_MAX);
}

}  // namespace
}  // namespace gloam
