// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/executor_conformance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/jobs/broken_executor.h"
#include "tests/jobs/executors.h"

namespace gloam {
namespace {

using test::BrokenExecutor;
using test::Flaw;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ExecutorFaults : public ::testing::TestWithParam<test::ExecutorCase> {};

INSTANTIATE_TEST_SUITE_P(All, ExecutorFaults, ::testing::ValuesIn(test::all_executors()),
                         [](const auto& test_case) { return test_case.param.name; });

TEST_P(ExecutorFaults, of_every_executor_here_are_none) {
  const auto executor = GetParam().make();
  EXPECT_THAT(executor_faults(*executor), IsEmpty());
}

TEST(executor_faults, of_the_broken_executor_without_a_flaw_are_none) {
  BrokenExecutor executor(Flaw::none);
  EXPECT_THAT(executor_faults(executor), IsEmpty());
}

TEST(executor_faults, name_the_rule_that_is_broken) {
  const std::pair<Flaw, const char*> cases[] = {
      {Flaw::no_threads, "worker_count: is 0"},
      {Flaw::thread_count_changes, "worker_count: changed from"},
      {Flaw::calls_the_body_for_nothing, "the body of a parallel_for was called for a count of 0"},
      {Flaw::throws_without_jobs, "calls without jobs: threw another exception (there are no jobs)"},
      {Flaw::drops_the_last_job, "run: job 2 of 3 had run 0 times"},
      {Flaw::runs_a_job_twice, "run: job 3 of 17 had run 2 times"},
      {Flaw::returns_early, "times when the call returned, not 1"},
      {Flaw::ranges_overlap, "parallel_for (65 by 64): range 1 is [63, 65)"},
      {Flaw::ignores_the_grain, "parallel_for (65 by 64): range 0 is [0, 65)"},
      {Flaw::range_count_overflows, "parallel_for (10 by SIZE_MAX): job 0 of 1 had run 0 times"},
      {Flaw::ordinals_from_the_back, "parallel_for (65 by 64): range"},
      {Flaw::runs_successors_early, "started before its predecessors had ended"},
      {Flaw::runs_double_edges_early, "started before its predecessors had ended"},
      {Flaw::changes_the_nodes, "run_graph: predecessor_count of node 17 was changed"},
      {Flaw::drops_unreached_nodes, "run_graph: job"},
      {Flaw::swallows_exceptions, "run, jobs fail: gave no exception"},
      {Flaw::rethrows_the_latest_failure, "run, jobs fail: gave the exception of job 199, not that of the failed job"},
      {Flaw::stops_below_the_lowest_failure, "parallel_for, jobs fail: gave the exception of job 199"},
      {Flaw::knows_standard_exceptions_only, "run, jobs fail: gave no exception"},
      {Flaw::hides_the_type_of_exceptions, "run, jobs fail: gave another exception (a job failed)"},
      {Flaw::runs_dependents_of_failed_nodes, "run_graph, nodes fail: node 2 ran, although it depends on a failed one"},
      {Flaw::skips_all_nodes_after_a_failure, "did not run once, although it depends on no failed one"},
      {Flaw::stops_for_ever_after_a_failure, "threw another exception (the pool has stopped)"},
      {Flaw::throws_a_failure_again, "after a failed run: threw"},
      {Flaw::refuses_nested_calls, "parallel_for, nested three deep: threw another exception (the pool is busy)"},
      {Flaw::loses_exceptions_of_nested_calls, "the outer call gave no exception"},
      // Which call and which job depends on when the threads meet.
      {Flaw::drops_jobs_of_other_threads, ", several threads call at once: job"},
      {Flaw::mixes_failures_of_threads, ", several threads call at once: threw the exception of job"},
  };
  for (const auto& [flaw, sentence] : cases) {
    std::vector<std::string> faults;
    // On a busy machine the threads of one attempt may miss each other.
    for (int attempt = 0; attempt < 50 && !::testing::Value(faults, Contains(HasSubstr(sentence))); ++attempt) {
      BrokenExecutor executor(flaw);
      faults = executor_faults(executor);
    }
    EXPECT_THAT(faults, Contains(HasSubstr(sentence))) << sentence;
  }
}

TEST(executor_faults, end_although_a_call_never_does) {
  static auto& executor = *new BrokenExecutor(Flaw::blocks_in_nested_calls);  // its blocked thread is left behind
  const auto faults = executor_faults(executor, {.hang_limit = std::chrono::milliseconds(300)});
  EXPECT_THAT(faults, ::testing::ElementsAre("nested calls: did not return within 300 ms"));
}

}  // namespace
}  // namespace gloam
