// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "engine/scene/transforms.h"
#include "tests/support/worse.h"

namespace gloam::test {

/// Nodes in rows of random order, with random parents: chains, stars and single nodes.
struct Forest {
  std::vector<std::uint32_t> parents;
  std::vector<std::uint32_t> depths;
  std::vector<LocalTransform> poses;
  std::vector<dmat4> locals;
};

[[nodiscard]] inline LocalTransform random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const dquat raw(unit(random) + 2.0, unit(random), unit(random), unit(random));
  const double length = std::sqrt(raw.w * raw.w + raw.x * raw.x + raw.y * raw.y + raw.z * raw.z);
  return {.translation = dvec3(unit(random), unit(random), unit(random)) * 3.0,
          .rotation = dquat(raw.w / length, raw.x / length, raw.y / length, raw.z / length),
          .scale = dvec3(1.0 + 0.2 * unit(random), 1.0 + 0.2 * unit(random), 1.0 + 0.2 * unit(random))};
}

[[nodiscard]] inline Forest random_forest(std::uint32_t seed, std::uint32_t count) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> row_of(count);  // nodes are created parents first, in shuffled rows
  std::iota(row_of.begin(), row_of.end(), 0u);
  std::shuffle(row_of.begin(), row_of.end(), random);
  Forest forest;
  forest.parents.assign(count, kNoParentRow);
  forest.depths.assign(count, 0);
  for (std::uint32_t node = 0; node < count; ++node) {
    forest.poses.push_back(random_pose(random));
    forest.locals.push_back(local_matrix(forest.poses.back()));
    const std::uint32_t shape = random() % 4;
    if (node == 0 || shape == 0) continue;
    const std::uint32_t parent = shape == 1 ? node - 1 : static_cast<std::uint32_t>(random() % node);
    forest.parents[row_of[node]] = row_of[parent];
    forest.depths[row_of[node]] = forest.depths[row_of[parent]] + 1;
  }
  return forest;
}

[[nodiscard]] inline dmat4 world_by_recursion(const Forest& forest, std::uint32_t row) {
  if (forest.parents[row] == kNoParentRow) return forest.locals[row];
  return world_by_recursion(forest, forest.parents[row]) * forest.locals[row];
}

/// Largest difference of an element, relative to the largest element of both matrices.
[[nodiscard]] inline double relative_difference(const dmat4& a, const dmat4& b) {
  double difference = 0.0;
  double size = 0.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      difference = worse(difference, std::abs(a[column][row] - b[column][row]));
      size = std::max({size, std::abs(a[column][row]), std::abs(b[column][row])});
    }
  }
  return size > 0.0 ? difference / size : difference;
}

}  // namespace gloam::test
