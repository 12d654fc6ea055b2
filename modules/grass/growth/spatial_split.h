// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/types.h"

namespace gloam {

struct SpatialItem {
  vec3 at = vec3(0.0f);
  std::uint32_t id = 0;  ///< unique
};

/// First item of group g: the groups' sizes differ by at most one.
[[nodiscard]] inline std::uint32_t group_begin(std::size_t items, std::uint32_t groups, std::uint32_t g) {
  return static_cast<std::uint32_t>(std::uint64_t{items} * g / groups);
}

/// Orders the items so that each of `groups` (≤ items.size(), ≥ 1) consecutive groups lies in a compact box: a k-d tree
/// that halves along the longest axis. Neighbouring groups have neighbouring numbers. A group's items are ordered by
/// id. unit: each run of this many groups, from a multiple of it on, lies in a compact box, too.
void split_by_space(std::span<SpatialItem> items, std::uint32_t groups, std::uint32_t unit = 1);
void split_by_space(std::span<SpatialItem> items, std::uint32_t groups, JobExecutor& jobs);

}  // namespace gloam
