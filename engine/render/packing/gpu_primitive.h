// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/render/packing/detail_level.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Ranges of a primitive in the scene's buffers, and the data with which the CPU culls and deforms it.
struct GpuPrimitive {
  std::uint32_t material = kNone;  ///< for GpuScene::material
  std::uint32_t vertex_count = 0;
  std::uint32_t first_vertex = 0;  ///< a multiple of 64, so that the byte offset of every stream is aligned for binding
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t simplified_first_index = 0;
  std::uint32_t simplified_index_count = 0;  ///< 0: the full indices cast its shadow (GpuScene::simplify_casters)
  std::uint32_t first_influence = 0;         ///< a multiple of 64
  std::uint32_t first_morph = 0;             ///< index of a float, a multiple of 64
  std::uint32_t morph_floats = 0;            ///< number of floats there
  std::uint32_t morph_targets = 0;
  bool morph_has_normals = false;
  bool skinned = false;
  bool colored = false;        ///< has vertex colours
  bool flat_shaded = false;    ///< deformed, with the normals of the triangles that are drawn
  bool closed = false;         ///< is_closed_surface()
  bool smooth_shaded = false;  ///< is_smooth_shaded(), in the rest pose
  bool simplification_tried = false;
  std::uint64_t content = 0;  ///< another number for each upload: two primitives with the same number are the same
  double longest_edge = 0.0;  ///< of a triangle that may have to be split (refined_triangles.h); 0: none may
  dvec3 origin = dvec3(0.0);  ///< point of the mesh that positions and bounds are relative to
  Aabb bounds;
  std::vector<Cluster> clusters;
  LevelsByUse detail;  ///< made when first needed (GpuScene::make_levels)
  /// Joint index and rest bounds of the vertices that follow the joint. The union of the posed boxes bounds the posed
  /// surface.
  std::vector<std::pair<std::uint32_t, Aabb>> joint_bounds;
  std::vector<Aabb> morph_bounds;  ///< bounds of the offsets of each target

  [[nodiscard]] const DetailLevels& levels(LevelUse use) const { return detail[static_cast<std::size_t>(use)]; }
};

}  // namespace gloam
