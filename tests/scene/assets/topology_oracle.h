// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/scene/assets/topology.h"

namespace gloam::test {

using Corners = std::array<std::uint32_t, 3>;

/// Whether the faces around a vertex form one fan or several open ones. A closed fan must be the only one.
[[nodiscard]] inline bool manifold_or_open(const std::vector<Corners>& faces, std::uint32_t vertex) {
  std::map<std::uint32_t, std::uint32_t>
      next;  // around the vertex, for each face: the corner after the vertex → the corner before it
  for (const Corners& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (face[i] == vertex) next[face[(i + 1) % 3]] = face[(i + 2) % 3];
    }
  }
  for (const auto& [start, unused] : next) {
    std::size_t steps = 0;
    std::uint32_t at = start;
    while (next.contains(at)) {
      at = next.at(at);
      ++steps;
      if (at == start) return steps == next.size();  // a closed fan: it must hold all faces
      if (steps > next.size()) break;
    }
  }
  return true;
}

/// Compares build_topology with brute force: faces are added one by one and each is checked against all faces before
/// it.
inline void expect_as_brute_force(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  const Topology topology = build_topology(positions, indices);
  const auto equal = [](const vec3& a, const vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
  std::vector<vec3> welded;
  std::vector<std::uint32_t> number;
  for (const vec3& p : positions) {
    std::uint32_t found = 0;
    while (found < welded.size() && !equal(welded[found], p)) ++found;
    if (found == welded.size()) welded.push_back(p);
    number.push_back(found);
  }
  ASSERT_EQ(topology.positions.size(), welded.size());
  for (std::size_t i = 0; i < welded.size(); ++i) EXPECT_TRUE(equal(topology.positions[i], welded[i]));

  std::vector<Corners> kept;
  std::vector<std::uint32_t> sources;
  std::uint32_t degenerate = 0;
  std::uint32_t refused = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::uint32_t f = 0; f < indices.size() / 3; ++f) {
    const Corners face{number[indices[3 * f]], number[indices[3 * f + 1]], number[indices[3 * f + 2]]};
    const dvec3 ab = dvec3(welded[face[1]]) - dvec3(welded[face[0]]);
    const dvec3 ac = dvec3(welded[face[2]]) - dvec3(welded[face[0]]);
    if (glm::length(glm::cross(ab, ac)) == 0.0) {
      ++degenerate;
      continue;
    }
    bool fits = true;
    for (std::size_t i = 0; i < 3; ++i) fits = fits && !sides.contains({face[i], face[(i + 1) % 3]});
    kept.push_back(face);
    for (std::size_t i = 0; i < 3 && fits; ++i) fits = manifold_or_open(kept, face[i]);
    if (!fits) {
      kept.pop_back();
      ++refused;
      continue;
    }
    sources.push_back(f);
    for (std::size_t i = 0; i < 3; ++i) sides.insert({face[i], face[(i + 1) % 3]});
  }
  EXPECT_EQ(topology.degenerate_faces, degenerate);
  EXPECT_EQ(topology.refused_faces, refused);
  EXPECT_EQ(topology.source_faces, sources);
  ASSERT_EQ(topology.faces, kept);
  ASSERT_EQ(topology.neighbors.size(), kept.size());
  ASSERT_EQ(topology.face_normals.size(), kept.size());
  for (std::size_t f = 0; f < kept.size(); ++f) {
    EXPECT_NEAR(glm::length(topology.face_normals[f]), 1.0f, 1e-6f);
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t across = ~0u;
      for (std::uint32_t other = 0; other < kept.size(); ++other) {
        for (std::size_t j = 0; j < 3; ++j) {
          if (kept[other][j] == kept[f][(i + 1) % 3] && kept[other][(j + 1) % 3] == kept[f][i]) across = other;
        }
      }
      EXPECT_EQ(topology.neighbors[f][i], across);
    }
  }
}

}  // namespace gloam::test
