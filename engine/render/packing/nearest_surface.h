// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/math/types.h"

namespace gloam {

/// Finds the point of a triangle mesh that is nearest to a given point, by a tree of boxes.
class NearestSurface {
 public:
  /// indices: a multiple of three, at least one triangle. Both spans must outlive the object.
  NearestSurface(std::span<const vec3> positions, std::span<const std::uint32_t> indices);

  struct Hit {
    float distance = 0.0f;
    std::uint32_t first_index = 0;  ///< of the triangle: a multiple of three
    vec3 weights = vec3(0.0f);      ///< barycentric coordinates in the triangle, ≥ 0
  };
  [[nodiscard]] Hit nearest(const vec3& point) const;

 private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: into triangles_; inner: index of the second child, the first one is next
    std::uint32_t count = 0;  ///< triangles of a leaf; 0: inner
  };
  void build(std::size_t begin, std::size_t end);
  [[nodiscard]] Hit nearest_of(std::uint32_t triangle, const vec3& point) const;

  std::span<const vec3> positions_;
  std::span<const std::uint32_t> indices_;
  std::vector<std::uint32_t> triangles_;  ///< first index of each, in the order of leaves
  std::vector<vec3> centers_;             ///< by triangle of `indices`; empty after construction
  std::vector<Node> nodes_;
};

}  // namespace gloam
