// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/scene/components.h"

namespace gloam {

/// Translation · rotation · scale. The rotation is unit length.
[[nodiscard]] dmat4 local_matrix(const LocalTransform& local);

/// Row of the parent that a root has.
inline constexpr std::uint32_t kNoParentRow = ~0u;

/// Rows of a forest, level by level: a row comes behind its parent's whole level.
struct TransformLevels {
  std::vector<std::uint32_t> order;   ///< rows; within a level ascending
  std::vector<std::uint32_t> starts;  ///< first place in `order` of each level, and one past the last
};

/// parents: row of each row's parent or kNoParentRow. depths: as many; the stated depths (0: root). Where a stated
/// depth does not fit the parents, all depths are computed again from the parents. A cycle asserts.
void build_levels(std::span<const std::uint32_t> parents, std::span<std::uint32_t> depths, TransformLevels& levels);

/// matrices: in, each row relative to its parent; out, each row to world. A level runs in parallel.
void compose_worlds(const TransformLevels& levels, std::span<const std::uint32_t> parents, JobExecutor& executor,
                    std::span<dmat4> matrices);

}  // namespace gloam
