// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/merged_mesh.h"

#include <meshoptimizer.h>

#include "engine/render/packing/mesh_packing.h"
#include "engine/scene/assets.h"

namespace gloam {

MergedMesh merged_by_position(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  MergedMesh merged;
  if (indices.empty()) return merged;
  merged.indices.resize(indices.size());
  meshopt_generateShadowIndexBuffer(merged.indices.data(), indices.data(), indices.size(), &positions[0].x,
                                    positions.size(), sizeof(vec3), sizeof(vec3));
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> place = fetch_order(positions.size(), merged.indices, count);
  merged.positions.resize(count);
  merged.original.resize(count);
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kNone) continue;
    merged.positions[place[v]] = positions[v];
    merged.original[place[v]] = v;
  }
  return merged;
}

}  // namespace gloam
