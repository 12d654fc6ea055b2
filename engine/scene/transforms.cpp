// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/transforms.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr std::size_t kTransformsPerJob = 512;
constexpr std::uint32_t kUnknownDepth = ~0u;

bool depths_fit(std::span<const std::uint32_t> parents, std::span<const std::uint32_t> depths) {
  for (std::size_t row = 0; row < parents.size(); ++row) {
    const std::uint32_t parent = parents[row];
    // Depths never fit a cycle: each row would have to be deeper than its parent.
    const std::uint64_t depth = parent == kNoParentRow ? 0 : std::uint64_t{depths[parent]} + 1;
    if (depths[row] != depth) return false;
  }
  return true;
}

void compute_depths(std::span<const std::uint32_t> parents, std::span<std::uint32_t> depths) {
  std::ranges::fill(depths, kUnknownDepth);
  std::vector<std::uint32_t> path;
  for (std::uint32_t row = 0; row < parents.size(); ++row) {
    path.clear();
    std::uint32_t at = row;
    while (at != kNoParentRow && depths[at] == kUnknownDepth) {
      GLOAM_ASSERT(path.size() < parents.size(), "the node tree has a cycle: an entity is its own ancestor");
      path.push_back(at);
      at = parents[at];
    }
    std::uint32_t depth = at == kNoParentRow ? 0 : depths[at] + 1;
    for (auto below = path.rbegin(); below != path.rend(); ++below) depths[*below] = depth++;
  }
}

}  // namespace

dmat4 local_matrix(const LocalTransform& local) {
  const glm::dmat3 rotation = glm::mat3_cast(local.rotation);
  return dmat4(dvec4(rotation[0] * local.scale.x, 0.0), dvec4(rotation[1] * local.scale.y, 0.0),
               dvec4(rotation[2] * local.scale.z, 0.0), dvec4(local.translation, 1.0));
}

void build_levels(std::span<const std::uint32_t> parents, std::span<std::uint32_t> depths, TransformLevels& levels) {
  GLOAM_ASSERT(parents.size() == depths.size(), "every row has a parent and a depth");
  if (!depths_fit(parents, depths)) compute_depths(parents, depths);

  std::uint32_t level_count = 0;
  for (const std::uint32_t depth : depths) level_count = std::max(level_count, depth + 1);
  levels.starts.assign(level_count + 1, 0);
  for (const std::uint32_t depth : depths) ++levels.starts[depth + 1];
  for (std::uint32_t level = 0; level < level_count; ++level) levels.starts[level + 1] += levels.starts[level];

  levels.order.resize(depths.size());
  std::vector<std::uint32_t> next(levels.starts.begin(), levels.starts.end() - 1);
  for (std::uint32_t row = 0; row < depths.size(); ++row) levels.order[next[depths[row]]++] = row;
}

void mark_descendants(const TransformLevels& levels, std::span<const std::uint32_t> parents,
                      std::span<std::uint8_t> marked) {
  if (levels.starts.size() < 2) return;
  for (const std::uint32_t row : std::span(levels.order).subspan(levels.starts[1]))
    marked[row] = marked[row] | marked[parents[row]];
}

void compose_worlds(const TransformLevels& levels, std::span<const std::uint32_t> parents,
                    std::span<const std::uint8_t> marked, JobExecutor& executor, std::span<dmat4> matrices) {
  for (std::size_t level = 1; level + 1 < levels.starts.size(); ++level) {
    const auto rows =
        std::span(levels.order).subspan(levels.starts[level], levels.starts[level + 1] - levels.starts[level]);
    executor.parallel_for(rows.size(), kTransformsPerJob, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t row = rows[i];
        if (marked[row] != 0) matrices[row] = matrices[parents[row]] * matrices[row];
      }
    });
  }
}

}  // namespace gloam
