// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"

namespace gloam {

/// ceil(count / grain) without overflow. grain ≥ 1, asserted.
[[nodiscard]] std::size_t range_count(std::size_t count, std::size_t grain);

/// The range with this ordinal, which must be below range_count(count, grain).
[[nodiscard]] JobRange job_range(std::size_t ordinal, std::size_t count, std::size_t grain);

/// Flag in a pending count: a predecessor failed or was skipped, so the node is skipped too.
inline constexpr std::uint32_t kSkipNode = 1u << 31;

/// Number of predecessors that each node waits for, by node index. Asserts that every edge leads to a later node, which
/// rules out cycles, and that each predecessor_count is the number of edges that end at its node. A graph that passes
/// always finishes.
[[nodiscard]] std::vector<std::uint32_t> pending_counts(std::span<const JobNode> nodes);

}  // namespace gloam
