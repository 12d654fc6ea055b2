// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/job_graph.h"

#include <algorithm>
#include <string>

#include "engine/core/assert.h"

namespace gloam {

std::size_t range_count(std::size_t count, std::size_t grain) {
  GLOAM_ASSERT(grain >= 1, "the grain of a parallel_for must be at least 1");
  return count / grain + (count % grain != 0 ? 1 : 0);
}

JobRange job_range(std::size_t ordinal, std::size_t count, std::size_t grain) {
  const std::size_t begin = ordinal * grain;
  return {begin, begin + std::min(grain, count - begin), ordinal};
}

std::vector<std::uint32_t> pending_counts(std::span<const JobNode> nodes) {
  std::vector<std::uint32_t> counts(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t successor : nodes[i].successors) {
      GLOAM_ASSERT(successor < nodes.size(), "node " + std::to_string(i) + " of a job graph names successor " +
                                                 std::to_string(successor) + ", but the graph has only " +
                                                 std::to_string(nodes.size()) + " nodes");
      GLOAM_ASSERT(successor > i, "node " + std::to_string(i) + " of a job graph names successor " +
                                      std::to_string(successor) +
                                      ", which does not lie behind it: edges must lead forward, so that no cycle can "
                                      "close");
      ++counts[successor];
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    GLOAM_ASSERT(counts[i] == nodes[i].predecessor_count,
                 "node " + std::to_string(i) + " of a job graph states " + std::to_string(nodes[i].predecessor_count) +
                     " predecessors, but " + std::to_string(counts[i]) + " edges end there");
  }
  return counts;
}

}  // namespace gloam
