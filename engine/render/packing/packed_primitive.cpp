// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/packed_primitive.h"

#include <utility>

#include "engine/render/packing/caster_bounds.h"
#include "engine/render/packing/closed_surface.h"
#include "engine/render/packing/refined_triangles.h"
#include "engine/render/packing/simplified_casters.h"
#include "engine/render/packing/smooth_shading.h"

namespace gloam {

PackedPrimitive pack_primitive(const Primitive& source, bool simplify) {
  PackedPrimitive packed;
  GpuPrimitive& primitive = packed.primitive;
  primitive.clusters = build_clusters(source, packed.indices);
  Primitive ordered = in_fetch_order(source, packed.indices);
  packed.frames = pack_frames(ordered);
  packed.surfaces = pack_surfaces(ordered);
  packed.influences = pack_influences(ordered);
  packed.morph_offsets = pack_morph_offsets(ordered, primitive.morph_has_normals);
  primitive.material = ordered.material;
  primitive.vertex_count = static_cast<std::uint32_t>(ordered.positions.size());
  primitive.index_count = static_cast<std::uint32_t>(packed.indices.size());
  primitive.morph_targets = static_cast<std::uint32_t>(ordered.morph_targets.size());
  primitive.skinned = !packed.influences.empty();
  primitive.colored = !ordered.colors.empty();
  primitive.flat_shaded = source.flat_shaded && (primitive.skinned || primitive.morph_targets > 0);
  primitive.closed = is_closed_surface(ordered.positions, packed.indices);
  primitive.smooth_shaded = is_smooth_shaded(ordered.positions, ordered.normals, packed.indices);
  primitive.bounds = ordered.bounds;
  if (!primitive.skinned && primitive.morph_targets == 0) primitive.longest_edge = longest_edge(source);
  primitive.joint_bounds = joint_bounds(ordered, packed.influences);
  primitive.morph_bounds = morph_bounds(ordered);
  packed.positions = std::move(ordered.positions);
  if (simplify) {
    primitive.simplification_tried = true;
    if (!primitive.skinned && primitive.morph_targets == 0)
      packed.simplified = simplified_indices(packed.positions, packed.indices);
  }
  return packed;
}

std::vector<PackedPrimitive> pack_mesh(const Mesh& mesh, const std::vector<bool>& simplify) {
  std::vector<PackedPrimitive> packed;
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
    packed.push_back(pack_primitive(mesh.primitives[p], simplify[p]));
  return packed;
}

}  // namespace gloam
