// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/simplified_casters.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "engine/render/packing/mesh_packing.h"

namespace gloam {
namespace {

constexpr std::size_t kFewestIndices =
    std::size_t{3} * 32;  ///< smaller meshes are not drawn faster with fewer triangles

}  // namespace

std::vector<std::uint32_t> simplified_indices(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  if (indices.size() < kFewestIndices) return {};
  std::vector<std::uint32_t> merged(indices.size());
  meshopt_generateShadowIndexBuffer(merged.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                    sizeof(vec3), sizeof(vec3));
  // The simplifier treats vertices at one position as a seam, even unused ones, so it gets only the used vertices.
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(positions.size(), merged, count);
  std::vector<vec3> used(count);
  std::vector<std::uint32_t> original(count);
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kNone) continue;
    used[place[v]] = positions[v];
    original[place[v]] = v;
  }
  const float side = meshopt_simplifyScale(&used[0].x, used.size(), sizeof(vec3));
  if (!(side > 0.0f)) return {};
  const float error = std::max(kSimplifiedShare, kSimplifiedError_m / side);
  std::vector<std::uint32_t> fewer(indices.size());
  fewer.resize(meshopt_simplify(fewer.data(), merged.data(), merged.size(), &used[0].x, used.size(), sizeof(vec3), 0,
                                error, meshopt_SimplifyLockBorder, nullptr));
  if (fewer.size() > indices.size() / 10 * 9) return {};
  for (std::uint32_t& index : fewer) index = original[index];
  return fewer;
}

std::vector<std::uint32_t> simplified_in_fetch_order(const Primitive& source) {
  std::vector<std::uint32_t> indices;
  static_cast<void>(build_clusters(source, indices));
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(source.positions.size(), indices, count);
  std::vector<vec3> positions(count);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] != kNone) positions[place[v]] = source.positions[v];
  return simplified_indices(positions, indices);
}

}  // namespace gloam
