// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/schedule/system.h"

namespace gloam {

/// The graph of one stage. Nodes are in order of registration, so edges lead to later nodes.
struct StagePlan {
  struct Node {
    std::uint32_t system = 0;  ///< index of the system
    std::vector<std::uint32_t>
        waits_for;  ///< direct dependencies: earlier nodes, ascending; implied waits are left out
    std::vector<std::uint32_t> successors;  ///< later nodes that wait for this one
  };
  std::vector<Node> nodes;
};

/// Plans the systems of `stage` for which `runs` is true. A system waits for every earlier one that it conflicts with
/// or must follow (System::after).
[[nodiscard]] StagePlan plan_stage(std::span<const std::unique_ptr<System>> systems, Stage stage,
                                   const std::function<bool(const System&)>& runs);

}  // namespace gloam
