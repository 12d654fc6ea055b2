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

/// Translation · rotation · scale. The rotation must have unit length.
[[nodiscard]] dmat4 local_matrix(const LocalTransform& local);

/// Parent row of a root.
inline constexpr std::uint32_t kNoParentRow = ~0u;

/// Rows of a forest by depth: all rows of a level come before those of the next level.
struct TransformLevels {
  std::vector<std::uint32_t> order;   ///< rows; ascending within a level
  std::vector<std::uint32_t> starts;  ///< index in `order` of each level's first row; then order.size()
};

/// parents: row of each row's parent, or kNoParentRow. depths: as many; the stated depths (0: root). If a stated depth
/// contradicts the parents, all depths are computed from the parents and overwritten. A cycle asserts.
void build_levels(std::span<const std::uint32_t> parents, std::span<std::uint32_t> depths, TransformLevels& levels);

/// Marks the rows below marked rows, too.
void mark_descendants(const TransformLevels& levels, std::span<const std::uint32_t> parents,
                      std::span<std::uint8_t> marked);

/// matrices of marked rows: in, the matrix relative to the parent; out, the world matrix. Those of all other rows: the
/// world matrix, which is only read. The rows of a level run in parallel.
void compose_worlds(const TransformLevels& levels, std::span<const std::uint32_t> parents,
                    std::span<const std::uint8_t> marked, JobExecutor& executor, std::span<dmat4> matrices);

}  // namespace gloam
