// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam::test {

/// A vertex in the world; the normal is of unit length.
struct Corner {
  dvec3 position = dvec3(0.0);
  dvec3 normal = dvec3(0.0);
};
using Facet = std::array<Corner, 3>;

[[nodiscard]] inline dvec3 point_of(const Facet& facet, const dvec3& share) {
  return share.x * facet[0].position + share.y * facet[1].position + share.z * facet[2].position;
}

/// The offset from a point of the facet to the smooth surface: towards each vertex's plane that is above the point, by
/// its distance along the vertex normal, weighted by the barycentric coordinates.
[[nodiscard]] inline dvec3 hanika_offset(const Facet& facet, const dvec3& share) {
  const dvec3 point = point_of(facet, share);
  dvec3 offset(0.0);
  for (int i = 0; i < 3; ++i) {
    const Corner& corner = facet[static_cast<std::size_t>(i)];
    offset -= share[i] * std::min(0.0, glm::dot(point - corner.position, corner.normal)) * corner.normal;
  }
  return offset;
}

[[nodiscard]] inline dvec3 interpolated_normal(const Facet& facet, const dvec3& share) {
  return glm::normalize(share.x * facet[0].normal + share.y * facet[1].normal + share.z * facet[2].normal);
}

/// Whether no vertex is above another vertex's plane by more than `slack` of their distance.
[[nodiscard]] inline bool is_convex(const Facet& facet, double slack = 0.0) {
  for (const Corner& a : facet)
    for (const Corner& b : facet)
      if (glm::dot(b.position - a.position, a.normal) > slack * glm::length(b.position - a.position)) return false;
  return true;
}

/// Facets of a mesh, with a matrix.
[[nodiscard]] inline std::vector<Facet> facets_of(const Primitive& mesh, const dmat4& matrix) {
  const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(matrix)));
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Facet facet;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t at = mesh.indices[i + c];
      facet[c] = {dvec3(matrix * dvec4(dvec3(mesh.positions[at]), 1.0)),
                  glm::normalize(turn * dvec3(mesh.normals[at]))};
    }
    facets.push_back(facet);
  }
  return facets;
}

/// The nearest facet that a ray hits.
struct FacetHit {
  const Facet* facet = nullptr;
  dvec3 share = dvec3(0.0);
  double distance = 0.0;
};
[[nodiscard]] inline std::optional<FacetHit> first_hit(const std::vector<Facet>& facets, const dvec3& origin,
                                                       const dvec3& direction) {
  std::optional<FacetHit> nearest;
  for (const Facet& facet : facets) {
    const dvec3 a = facet[1].position - facet[0].position, b = facet[2].position - facet[0].position;
    const dvec3 normal = glm::cross(a, b), from = origin - facet[0].position;
    const double along = -glm::dot(direction, normal);
    if (std::abs(along) < 1e-30) continue;
    const double distance = glm::dot(from, normal) / along;
    const dvec3 turned = glm::cross(from, direction);
    const double u = glm::dot(b, turned) / along, v = -glm::dot(a, turned) / along;
    if (distance <= 0.0 || std::min({u, v, 1.0 - u - v}) < 0.0) continue;
    if (!nearest || distance < nearest->distance) nearest = FacetHit{&facet, dvec3(1.0 - u - v, u, v), distance};
  }
  return nearest;
}

}  // namespace gloam::test
