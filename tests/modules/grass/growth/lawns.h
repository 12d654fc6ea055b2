// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/core/hash.h"
#include "engine/scene/assets.h"
#include "modules/grass/growth/patches.h"
#include "modules/grass/growth/scatter.h"
#include "modules/grass/growth/surface.h"

namespace gloam::test {

inline Mesh mesh_of(std::vector<vec3> positions, std::vector<std::uint32_t> indices) {
  Mesh mesh;
  mesh.primitives.emplace_back();
  mesh.primitives[0].positions = std::move(positions);
  mesh.primitives[0].indices = std::move(indices);
  return mesh;
}

/// A square of cells · cells quads around the origin, at height(x, z).
inline Mesh lawn(
    std::uint32_t cells, float size_m,
    const std::function<float(float, float)>& height = [](float, float) { return 0.0f; }) {
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const float x = (static_cast<float>(i) / static_cast<float>(cells) - 0.5f) * size_m;
      const float z = (static_cast<float>(j) / static_cast<float>(cells) - 0.5f) * size_m;
      positions.emplace_back(x, height(x, z), z);
      if (i == cells || j == cells) continue;
      const std::uint32_t a = j * (cells + 1) + i;
      const std::uint32_t c = a + cells + 1;
      indices.insert(indices.end(), {a, c, a + 1, a + 1, c, c + 1});
    }
  }
  return mesh_of(std::move(positions), std::move(indices));
}

inline float hills(float x, float z) { return 0.8f * std::sin(0.9f * x) * std::cos(0.7f * z); }

inline std::vector<dvec3> positions_of(const GrowthSurface& surface, std::span<const ScatteredRoot> roots) {
  std::vector<dvec3> positions;
  for (const ScatteredRoot& root : roots) positions.push_back(root_position(surface, root));
  return positions;
}

/// Index of Clark and Evans: the mean distance to the nearest other point over that of a random pattern. Only points
/// whose x and z are within `inner_m` of 0 are counted, because those near the border have fewer neighbours; of many
/// points about 2,000 are enough.
inline double clark_evans(std::span<const dvec3> points, double area_m2, double inner_m) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 4000) {
    const dvec3& p = points[i];
    if (std::max(std::abs(p.x), std::abs(p.z)) > inner_m) continue;
    double nearest = 1e300;
    for (const dvec3& q : points) {
      const dvec3 d = q - p;
      if (&p != &q) nearest = std::min(nearest, glm::dot(d, d));
    }
    sum += std::sqrt(nearest);
    ++count;
  }
  const double random = 0.5 / std::sqrt(static_cast<double>(points.size()) / area_m2);
  return sum / static_cast<double>(count) / random;
}

inline std::uint64_t hash_of(std::span<const ScatteredRoot> roots) {
  Hasher hasher;
  for (const ScatteredRoot& root : roots)
    hasher.value(root.triangle)
        .value(std::bit_cast<std::uint64_t>(root.weight1))
        .value(std::bit_cast<std::uint64_t>(root.weight2));
  return hasher.digest();
}

/// Hash of all values relative to the patches; the patches' origins are left out.
inline std::uint64_t hash_of(std::span<const GrassPatch> patches, std::span<const GrassBlade> blades) {
  Hasher hasher;
  const auto number = [&](float value) { hasher.value(std::bit_cast<std::uint32_t>(value)); };
  const auto vector = [&](const vec3& v) {
    for (int i = 0; i < 3; ++i) number(v[i]);
  };
  for (const GrassPatch& patch : patches) {
    vector(patch.roots.min);
    vector(patch.roots.max);
    number(patch.reach_m);
    number(patch.max_distance_m);
    hasher.value(patch.index).value(patch.blades).value(patch.masters);
  }
  for (const GrassBlade& blade : blades) {
    vector(blade.root_m);
    vector(blade.ground_normal);
    for (const float value : {blade.yaw, blade.length_m, blade.width_m, blade.rank}) number(value);
    hasher.value(blade.slot).value(blade.master).value(blade.type).value(blade.layer);
  }
  return hasher.digest();
}

}  // namespace gloam::test
