// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/simplified_casters.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "engine/render/packing/merged_mesh.h"
#include "engine/render/packing/mesh_packing.h"

namespace gloam {
namespace {

constexpr std::size_t kFewestIndices =
    std::size_t{3} * 32;  ///< smaller meshes are not drawn faster with fewer triangles

}  // namespace

std::vector<std::uint32_t> simplified_indices(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  if (indices.size() < kFewestIndices) return {};
  const MergedMesh merged = merged_by_position(positions, indices);
  const std::size_t vertices = merged.positions.size();
  const float side = meshopt_simplifyScale(&merged.positions[0].x, vertices, sizeof(vec3));
  if (!(side > 0.0f)) return {};
  const float error = std::max(kSimplifiedShare, kSimplifiedError_m / side);
  std::vector<std::uint32_t> fewer(indices.size());
  fewer.resize(meshopt_simplify(fewer.data(), merged.indices.data(), merged.indices.size(), &merged.positions[0].x,
                                vertices, sizeof(vec3), 0, error, meshopt_SimplifyLockBorder, nullptr));
  if (fewer.size() > indices.size() / 10 * 9) return {};
  for (std::uint32_t& index : fewer) index = merged.original[index];
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
