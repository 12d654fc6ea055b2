// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/schedule/stage_plan.h"

#include <algorithm>

namespace gloam {

StagePlan plan_stage(std::span<const std::unique_ptr<System>> systems, Stage stage,
                     const std::function<bool(const System&)>& runs) {
  StagePlan plan;
  for (std::uint32_t i = 0; i < systems.size(); ++i) {
    if (contains(systems[i]->stages, stage) && runs(*systems[i])) plan.nodes.push_back({i, {}, {}});
  }
  std::vector<std::vector<bool>> waited(plan.nodes.size());  // per node: earlier nodes it waits for, at any distance
  for (std::uint32_t j = 0; j < plan.nodes.size(); ++j) {
    StagePlan::Node& node = plan.nodes[j];
    const System& system = *systems[node.system];
    waited[j].resize(plan.nodes.size(), false);
    for (std::uint32_t i = j; i-- > 0;) {  // nearest first: nodes that it waits for need no edge
      if (waited[j][i]) continue;
      const std::uint32_t earlier = plan.nodes[i].system;
      const bool told = std::ranges::find(system.after, earlier) != system.after.end();
      if (!told && !conflict(system.access, systems[earlier]->access)) continue;
      node.waits_for.push_back(i);
      plan.nodes[i].successors.push_back(j);
      waited[j][i] = true;
      for (std::uint32_t k = 0; k < i; ++k) waited[j][k] = waited[j][k] || waited[i][k];
    }
    std::ranges::reverse(node.waits_for);
  }
  return plan;
}

}  // namespace gloam
