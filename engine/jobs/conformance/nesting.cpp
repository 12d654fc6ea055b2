// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "engine/jobs/conformance/trials.h"

namespace gloam::conformance {

std::string nests(Subject& s) {
  auto& leaves = s.keep<std::atomic<int>>(0);
  const Outcome loops = outcome_of([&] {
    s.executor.parallel_for(6, 1, [&](JobRange) {
      s.executor.parallel_for(6, 1, [&](JobRange) {
        s.executor.parallel_for(12, 2, [&](JobRange range) { leaves += static_cast<int>(range.end - range.begin); });
      });
    });
  });
  const std::string count = leaves == 6 * 6 * 12 ? "" : std::to_string(leaves) + " of 432 indices were covered";
  if (std::string fault = fault_of("parallel_for, nested three deep", loops, count); !fault.empty()) return fault;
  for (int outer = 0; outer < 9; ++outer) {
    auto& tallies = s.keep<std::vector<std::unique_ptr<Tally>>>();
    auto& jobs = s.keep<Jobs>();
    auto& inside = s.keep<std::vector<Subject>>(4u, Subject{s.executor});  // one a job: Subject::keep is for one thread
    for (std::size_t i = 0; i < 4; ++i) {
      tallies.push_back(std::make_unique<Tally>(30u));
      jobs.emplace_back([&, outer, i] {
        const Outcome inner = run_one_of(inside[i], outer % 3, *tallies[i], false);
        if (inner.threw) throw std::runtime_error("the inner call threw " + inner.text());
      });
    }
    auto& graph = s.keep<TrialGraph>(4u);
    for (std::uint32_t i = 0; i < 4; ++i) graph.nodes[i].work = jobs[i];
    graph.edge(0, 1);
    graph.edge(0, 2);
    const Outcome outcome = outcome_of([&] {
      if (outer / 3 == 0) s.executor.run(jobs);
      if (outer / 3 == 1) s.executor.parallel_for(4, 1, [&](JobRange range) { jobs[range.ordinal](); });
      if (outer / 3 == 2) s.executor.run_graph(graph.nodes);
    });
    const std::string call = std::string(kCallKinds[outer % 3]) + " inside " + kCallKinds[outer / 3];
    for (const auto& tally : tallies)
      if (std::string fault = fault_of(call.c_str(), outcome, tally->fault()); !fault.empty()) return fault;
  }
  return {};
}

std::string passes_failures_through_nested_calls(Subject& s) {
  const auto fails = [](JobRange range) {
    if (range.ordinal == 2) throw JobFailed{range.ordinal};
  };
  const Outcome passed =
      outcome_of([&] { s.executor.parallel_for(6, 1, [&](JobRange) { s.executor.parallel_for(6, 1, fails); }); });
  if (passed.job != 2u)
    return "a job whose nested call failed: the outer call gave " + passed.text() + ", not that of the nested job 2";
  auto& tally = s.keep<Tally>(6u);
  auto& caught = s.keep<std::atomic<int>>(0);
  const Outcome handled = outcome_of([&] {
    s.executor.parallel_for(6, 1, [&](JobRange range) {
      tally.run(range.ordinal, [&] {
        if (outcome_of([&] { s.executor.parallel_for(6, 1, fails); }).job == 2u) ++caught;
      });
    });
  });
  const std::string counts =
      caught == 6 ? tally.fault() : "only " + std::to_string(caught) + " of 6 nested calls gave their exception";
  return fault_of("a job that catches the exception of its nested call", handled, counts);
}

std::string serves_several_threads_at_once(Subject& s) {
  constexpr std::size_t kCallers = 4;
  std::vector<Subject> callers;
  for (std::size_t i = 0; i < kCallers; ++i) callers.push_back({s.executor});
  std::vector<std::string> faults(kCallers);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kCallers; ++t) {
    threads.emplace_back([&, t] {
      for (std::uint32_t round = 0; round < s.rounds * 3 && faults[t].empty(); ++round) {
        auto& tally = callers[t].keep<Tally>(30u);
        const bool fails = t == 0;  // the others must not notice
        const int kind = static_cast<int>(round % 3);
        const Outcome outcome = run_one_of(callers[t], kind, tally, fails);
        const std::string call = std::string(kCallKinds[kind]) + ", several threads call at once";
        if (!fails) faults[t] = fault_of(call.c_str(), outcome, tally.fault());
        if (fails && outcome.job != 7u) faults[t] = call + ": gave " + outcome.text() + ", not that of job 7";
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Subject& caller : callers) s.kept.insert(s.kept.end(), caller.kept.begin(), caller.kept.end());
  for (const std::string& fault : faults)
    if (!fault.empty()) return fault;
  return {};
}

std::string orders_memory(Subject& s) {
  for (std::uint32_t round = 0; round < s.rounds; ++round) {
    std::vector<std::uint32_t> values(1000, round);
    s.executor.parallel_for(values.size(), 10, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) ++values[i];
    });
    if (std::count(values.begin(), values.end(), round + 1) != 1000)
      return "parallel_for: the caller does not see what jobs wrote";
    TrialGraph graph(100);
    std::uint32_t last = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
      if (i > 0) graph.edge(i - 1, i);
      graph.nodes[i].work = [&last, i] { last = last == i ? i + 1 : last; };
    }
    s.executor.run_graph(graph.nodes);
    if (last != 100) return "run_graph: a node does not see what its predecessors wrote";
  }
  return {};
}

}  // namespace gloam::conformance
