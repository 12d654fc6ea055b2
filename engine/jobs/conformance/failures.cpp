// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/jobs/conformance/trials.h"

namespace gloam::conformance {

namespace {

constexpr std::size_t kFailingJobs[] = {20, 21, 90, 199};
constexpr std::size_t kLowestFailing = kFailingJobs[0];

/// Runs 200 jobs, of which kFailingJobs fail. run(job): calls job(0) … job(199) on the executor.
template <class Run>
std::string rethrows_the_lowest_failure(Subject& s, const char* call, Run&& run) {
  std::vector<std::pair<Tally*, int>> rounds;  // and the number of jobs that had started when the call returned
  for (std::uint32_t round = 0; round < s.rounds; ++round) {
    auto& tally = s.keep<Tally>(200u);
    auto& failures = s.keep<std::atomic<int>>(0);
    auto& job = s.keep<std::function<void(std::size_t)>>([&](std::size_t i) {
      tally.run(i, [&] {
        pause_some(i);
        if (std::find(std::begin(kFailingJobs), std::end(kFailingJobs), i) == std::end(kFailingJobs)) return;
        if (i == kLowestFailing && s.executor.worker_count() > 1) await_briefly(failures);
        ++failures;
        throw JobFailed{i};
      });
    });
    const Outcome outcome = outcome_of([&] { run(job); });
    rounds.emplace_back(&tally, tally.starts());
    const std::string start = std::string(call) + ", jobs fail: ";
    if (tally.inside() != 0) return start + "threw before the jobs that had started had ended";
    if (outcome.job != kLowestFailing)
      return start + "gave " + outcome.text() + ", not that of the failed job with the lowest index, " +
             std::to_string(kLowestFailing);
    if (const std::string fault = tally.fault(0, kLowestFailing); !fault.empty()) return start + fault;
    for (std::size_t i = kLowestFailing; i < 200; ++i)
      if (tally.started(i) > 1) return start + "job " + std::to_string(i) + " ran twice";
  }
  for (const auto& [tally, starts] : rounds)
    if (tally->starts() != starts) return std::string(call) + ", jobs fail: further jobs started after it had thrown";
  return {};
}

}  // namespace

std::string rethrows_failures_of_batches(Subject& s) {
  return rethrows_the_lowest_failure(s, "run", [&](const std::function<void(std::size_t)>& job) {
    auto& jobs = s.keep<Jobs>();
    for (std::size_t i = 0; i < 200; ++i) jobs.emplace_back([&job, i] { job(i); });
    s.executor.run(jobs);
  });
}

std::string rethrows_failures_of_loops(Subject& s) {
  return rethrows_the_lowest_failure(s, "parallel_for", [&](const std::function<void(std::size_t)>& job) {
    auto& body = s.keep<std::function<void(JobRange)>>([&job](JobRange range) { job(range.ordinal); });
    s.executor.parallel_for(1995, 10, body);
  });
}

/// Edges: 0 → 1 → 2, 3 → 4 → 6, 5 → 6, and node 7. Nodes 1 and 4 fail, node 4 first if they run at once.
std::string skips_what_depends_on_failed_nodes(Subject& s) {
  constexpr int kRuns[] = {1, 1, 0, 1, 1, 1, 0, 1};
  for (std::uint32_t round = 0; round < s.rounds; ++round) {
    auto& graph = s.keep<TrialGraph>(8u);
    for (const auto& [from, to] : {std::pair(0u, 1u), {1u, 2u}, {3u, 4u}, {4u, 6u}, {5u, 6u}}) graph.edge(from, to);
    for (std::size_t i = 0; i < 8; ++i) {
      graph.nodes[i].work = [&graph, &s, i] {
        graph.tally.run(i, [&] {
          if (i == 1 && s.executor.worker_count() > 1) await_briefly(graph.failures);
          if (i != 1 && i != 4) return;
          ++graph.failures;
          throw JobFailed{i};
        });
      };
    }
    const Outcome outcome = outcome_of([&] { s.executor.run_graph(graph.nodes); });
    const std::string start = "run_graph, nodes fail: ";
    if (graph.tally.inside() != 0) return start + "threw before the nodes that had started had ended";
    if (outcome.job != 1u)
      return start + "gave " + outcome.text() + ", not that of the failed node with the lowest index, 1";
    for (std::size_t i = 0; i < 8; ++i) {
      if (graph.tally.started(i) == kRuns[i]) continue;
      return start + "node " + std::to_string(i) +
             (kRuns[i] == 0 ? " ran, although it depends on a failed one"
                            : " did not run once, although it depends on no failed one");
    }
  }
  return {};
}

std::string passes_exceptions_of_empty_functions(Subject& s) {
  auto& jobs = s.keep<Jobs>(3u);
  jobs[0] = jobs[2] = [] {};
  try {
    s.executor.run(jobs);
  } catch (const std::bad_function_call&) {
    return {};
  } catch (...) {
    return "run, a function is empty: threw another exception than std::bad_function_call";
  }
  return "run, a function is empty: did not throw std::bad_function_call";
}

Outcome run_one_of(Subject& s, int kind, Tally& tally, bool fails) {
  const auto job = [&tally, fails](std::size_t i) {
    tally.run(i, [&] {
      if (fails && i == 7) throw JobFailed{i};
    });
  };
  if (kind == 0) {
    auto& jobs = s.keep<Jobs>();
    for (std::size_t i = 0; i < 30; ++i) jobs.emplace_back([job, i] { job(i); });
    return outcome_of([&] { s.executor.run(jobs); });
  }
  if (kind == 1) {
    auto& body = s.keep<std::function<void(JobRange)>>([job](JobRange range) { job(range.ordinal); });
    return outcome_of([&] { s.executor.parallel_for(60, 2, body); });
  }
  auto& graph = s.keep<TrialGraph>(30u);
  for (std::uint32_t i = 0; i < 30; ++i) {
    graph.nodes[i].work = [job, i] { job(i); };
    if (i >= 10) graph.edge(i - 10, i);
  }
  return outcome_of([&] { s.executor.run_graph(graph.nodes); });
}

std::string works_after_a_failure(Subject& s) {
  for (int failed = 0; failed < 3; ++failed)
    for (int next = 0; next < 3; ++next) {
      (void)run_one_of(s, failed, s.keep<Tally>(30u), true);
      auto& tally = s.keep<Tally>(30u);
      const Outcome outcome = run_one_of(s, next, tally, false);
      const std::string call = std::string(kCallKinds[next]) + " after a failed " + kCallKinds[failed];
      if (std::string fault = fault_of(call.c_str(), outcome, tally.fault()); !fault.empty()) return fault;
    }
  return {};
}

}  // namespace gloam::conformance
