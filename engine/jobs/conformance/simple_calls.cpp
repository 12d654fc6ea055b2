// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <mutex>

#include "engine/jobs/conformance/trials.h"

namespace gloam::conformance {

namespace {

/// The same numbers on every platform (Numerical Recipes' linear congruential generator).
struct Numbers {
  std::uint32_t state = 1;
  std::uint32_t below(std::uint32_t bound) { return (state = state * 1664525u + 1013904223u) / 65536u % bound; }
};

/// The ranges that the body of a loop was called with.
struct Ranges {
  explicit Ranges(std::size_t count) : tally(count) {}
  Tally tally;
  std::mutex mutex;
  std::string wrong;
};

}  // namespace

std::string counts_its_threads(Subject& s) {
  const std::uint32_t first = s.executor.worker_count();
  if (first == 0) return "worker_count: is 0, but the thread of the caller counts";
  s.executor.parallel_for(10, 1, s.keep<std::function<void(JobRange)>>([](JobRange) {}));
  const std::uint32_t then = s.executor.worker_count();
  return then == first ? std::string()
                       : "worker_count: changed from " + std::to_string(first) + " to " + std::to_string(then);
}

std::string does_nothing_without_jobs(Subject& s) {
  auto& calls = s.keep<std::atomic<int>>(0);
  auto& body = s.keep<std::function<void(JobRange)>>([&calls](JobRange) { ++calls; });
  const Outcome outcome = outcome_of([&] {
    s.executor.run({});
    s.executor.run_graph({});
    for (const std::size_t grain : {std::size_t{1}, std::size_t{64}, SIZE_MAX}) s.executor.parallel_for(0, grain, body);
  });
  return fault_of("calls without jobs", outcome,
                  calls.load() == 0 ? "" : "the body of a parallel_for was called for a count of 0");
}

std::string runs_each_job_once(Subject& s) {
  for (const std::size_t count : {1u, 2u, 3u, 17u, 500u}) {
    auto& tally = s.keep<Tally>(count);
    auto& jobs = s.keep<Jobs>();
    for (std::size_t i = 0; i < count; ++i) jobs.emplace_back([&tally, i] { tally.run(i); });
    const Outcome outcome = outcome_of([&] { s.executor.run(jobs); });
    if (std::string fault = fault_of("run", outcome, tally.fault()); !fault.empty()) return fault;
  }
  return {};
}

std::string covers_each_index_once(Subject& s) {
  constexpr std::pair<std::size_t, std::size_t> kLoops[] = {{1, 1},    {63, 64}, {64, 64}, {65, 64},
                                                            {1000, 7}, {500, 1}, {10, 11}, {10, SIZE_MAX}};
  for (const auto& loop : kLoops) {
    const std::size_t count = loop.first;  // clang 14 captures no structured bindings
    const std::size_t grain = loop.second;
    const std::size_t expected = count / grain + (count % grain != 0 ? 1 : 0);
    auto& ranges = s.keep<Ranges>(expected);
    auto& body = s.keep<std::function<void(JobRange)>>([&ranges, expected, count, grain](JobRange range) {
      const std::size_t begin = range.ordinal * grain;
      if (range.ordinal < expected && range.begin == begin && range.end - begin == std::min(grain, count - begin)) {
        ranges.tally.run(range.ordinal);
        return;
      }
      const std::lock_guard lock(ranges.mutex);
      ranges.wrong = "range " + std::to_string(range.ordinal) + " is [" + std::to_string(range.begin) + ", " +
                     std::to_string(range.end) + ")";
    });
    const Outcome outcome = outcome_of([&] { s.executor.parallel_for(count, grain, body); });
    const std::lock_guard lock(ranges.mutex);
    const std::string counts = ranges.wrong.empty() ? ranges.tally.fault() : ranges.wrong;
    const std::string call = "parallel_for (" + std::to_string(count) + " by " +
                             (grain == SIZE_MAX ? "SIZE_MAX" : std::to_string(grain)) + ")";
    if (std::string fault = fault_of(call.c_str(), outcome, counts); !fault.empty()) return fault;
  }
  return {};
}

std::string runs_nodes_after_their_predecessors(Subject& s) {
  Numbers numbers;
  for (std::uint32_t round = 0; round < s.rounds + 2; ++round) {
    const std::uint32_t count = round == 0 ? 1 : 2 + numbers.below(60);
    auto& graph = s.keep<TrialGraph>(count);
    for (std::uint32_t to = 1; to < count; ++to) {
      const std::uint32_t edges = round == 1 ? 1 : numbers.below(4);  // round 1: all nodes follow the first
      for (std::uint32_t n = 0; n < edges; ++n) graph.edge(round == 1 ? 0 : numbers.below(to), to);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      graph.nodes[i].work = [&graph, i] {
        for (const std::uint32_t from : graph.predecessors[i])
          if (graph.tally.ended(from) <= graph.tally.ended(i)) graph.early = static_cast<int>(i);
        graph.tally.run(i);
      };
    }
    for (int repeat = 1; repeat <= 2; ++repeat) {
      const Outcome outcome = outcome_of([&] { s.executor.run_graph(graph.nodes); });
      std::string counts = graph.tally.fault(0, count, repeat);
      if (graph.early >= 0)
        counts = "node " + std::to_string(graph.early) + " started before its predecessors had ended";
      for (std::uint32_t i = 0; i < count; ++i)
        if (graph.nodes[i].predecessor_count != graph.predecessors[i].size())
          counts = "predecessor_count of node " + std::to_string(i) + " was changed";
      const char* call = repeat == 1 ? "run_graph" : "run_graph, the same nodes again";
      if (std::string fault = fault_of(call, outcome, counts); !fault.empty()) return fault;
    }
  }
  return {};
}

}  // namespace gloam::conformance
