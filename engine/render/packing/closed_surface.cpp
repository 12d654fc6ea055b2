// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/closed_surface.h"

#include <meshoptimizer.h>

#include <cstddef>
#include <vector>

namespace gloam {
namespace {

/// A random number of an edge's direction (the finalizer of SplitMix64), so that a sum of them tells multisets apart.
std::uint64_t number_of(std::uint32_t from, std::uint32_t to) {
  std::uint64_t x = (std::uint64_t{from} << 32 | to) + 0x9E3779B97F4A7C15u;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

}  // namespace

bool is_closed_surface(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  if (indices.empty() || indices.size() % 3 != 0) return false;
  std::vector<std::uint32_t> welded(indices.size());
  meshopt_generateShadowIndexBuffer(welded.data(), indices.data(), indices.size(), positions.data(), positions.size(),
                                    sizeof(vec3), sizeof(vec3));
  std::uint64_t forth = 0, back = 0;
  double volume = 0.0;
  const dvec3 origin(positions[welded[0]]);
  for (std::size_t i = 0; i < welded.size(); i += 3) {
    const std::uint32_t corners[] = {welded[i], welded[i + 1], welded[i + 2]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      forth += number_of(corners[c], corners[(c + 1) % 3]);
      back += number_of(corners[(c + 1) % 3], corners[c]);
    }
    const dvec3 a = dvec3(positions[corners[0]]) - origin, b = dvec3(positions[corners[1]]) - origin,
                c = dvec3(positions[corners[2]]) - origin;
    volume += glm::dot(a, glm::cross(b, c));
  }
  return forth == back && volume > 0.0;
}

}  // namespace gloam
