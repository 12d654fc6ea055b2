// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/nearest_surface.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr std::size_t kLeafTriangles = 4;
constexpr std::size_t kDeepest = 64;  ///< halving 2^32 triangles takes fewer steps

float distance_squared(const Aabb& box, const vec3& point) {
  const vec3 off = point - glm::clamp(point, box.min, box.max);
  return glm::dot(off, off);
}

/// Share of the way from a to b at which the segment is nearest to the origin.
float nearest_share(const vec3& a, const vec3& b) {
  const vec3 along = b - a;
  const float length = glm::dot(along, along);
  return length > 0.0f ? std::clamp(-glm::dot(a, along) / length, 0.0f, 1.0f) : 0.0f;
}

/// Barycentric coordinates of the point of a triangle that is nearest to the origin.
vec3 nearest_weights(const std::array<vec3, 3>& corners) {
  const vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const vec3 normal = glm::cross(u, v);
  const float area = glm::dot(normal, normal);
  if (area > 0.0f) {
    const float second = glm::dot(glm::cross(-corners[0], v), normal) / area;
    const float third = glm::dot(glm::cross(u, -corners[0]), normal) / area;
    if (second >= 0.0f && third >= 0.0f && second + third <= 1.0f) return {1.0f - second - third, second, third};
  }
  vec3 best(1.0f, 0.0f, 0.0f);
  float least = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const vec3 &a = corners[static_cast<std::size_t>(k)], &b = corners[static_cast<std::size_t>(next)];
    const float share = nearest_share(a, b);
    const vec3 at = a + (b - a) * share;
    if (const float d = glm::dot(at, at); d < least) {
      least = d;
      best = vec3(0.0f);
      best[k] = 1.0f - share;
      best[next] = share;
    }
  }
  return best;
}

}  // namespace

NearestSurface::NearestSurface(std::span<const vec3> positions, std::span<const std::uint32_t> indices)
    : positions_(positions), indices_(indices) {
  GLOAM_ASSERT(indices.size() >= 3 && indices.size() % 3 == 0, "a mesh with triangles");
  for (std::uint32_t i = 0; i < indices.size(); i += 3) {
    triangles_.push_back(i);
    centers_.push_back((positions[indices[i]] + positions[indices[i + 1]] + positions[indices[i + 2]]) / 3.0f);
  }
  build(0, triangles_.size());
  centers_ = {};
}

void NearestSurface::build(std::size_t begin, std::size_t end) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Aabb box, centers;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) box.grow(positions_[indices_[triangles_[i] + k]]);
    centers.grow(centers_[triangles_[i] / 3]);
  }
  nodes_[at].box = box;
  if (end - begin <= kLeafTriangles) {
    nodes_[at].first = static_cast<std::uint32_t>(begin);
    nodes_[at].count = static_cast<std::uint32_t>(end - begin);
    return;
  }
  const vec3 size = centers.max - centers.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto place = [this](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(begin), place(middle), place(end),
                   [&](std::uint32_t a, std::uint32_t b) { return centers_[a / 3][axis] < centers_[b / 3][axis]; });
  build(begin, middle);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

NearestSurface::Hit NearestSurface::nearest_of(std::uint32_t triangle, const vec3& point) const {
  std::array<vec3, 3> corners;
  for (std::uint32_t k = 0; k < 3; ++k) corners[k] = positions_[indices_[triangle + k]] - point;
  const vec3 weights = nearest_weights(corners);
  return {glm::length(corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z), triangle, weights};
}

NearestSurface::Hit NearestSurface::nearest(const vec3& point) const {
  Hit best{std::numeric_limits<float>::infinity(), 0, vec3(1.0f, 0.0f, 0.0f)};
  struct Open {
    std::uint32_t node;
    float distance_squared;
  };
  std::array<Open, kDeepest> stack;
  std::size_t open = 0;
  stack[open++] = {0, distance_squared(nodes_[0].box, point)};
  while (open > 0) {
    const Open next = stack[--open];
    if (next.distance_squared >= best.distance * best.distance) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = 0; i < node.count; ++i)
      if (const Hit hit = nearest_of(triangles_[node.first + i], point); hit.distance < best.distance) best = hit;
    if (node.count > 0) continue;
    Open first{next.node + 1, distance_squared(nodes_[next.node + 1].box, point)};
    Open second{node.first, distance_squared(nodes_[node.first].box, point)};
    if (first.distance_squared < second.distance_squared) std::swap(first, second);
    stack[open++] = first;
    stack[open++] = second;  // the nearer one is taken next
  }
  return best;
}

}  // namespace gloam
