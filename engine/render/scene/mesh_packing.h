// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/assets.h"

namespace gloam {

/// Stream 1 of a vertex: what turns with the surface. Octahedral snorm16 codes; the lowest bit of the tangent's second
/// coordinate carries the handedness (1 = −1).
struct PackedFrame {
  std::uint32_t normal = 0;
  std::uint32_t tangent = 0;
};

/// Stream 2 of a vertex: what never moves.
struct PackedSurface {
  vec2 uv0 = vec2(0.0f);
  vec2 uv1 = vec2(0.0f);
  std::uint32_t color = 0xFFFFFFFFu;  ///< unorm8 RGBA
};

/// Four joints of 16 bits, four unorm16 weights.
struct PackedInfluence {
  std::uint32_t joints01 = 0;
  std::uint32_t joints23 = 0;
  std::uint32_t weights01 = 0;
  std::uint32_t weights23 = 0;
};

/// A run of neighbouring triangles that is culled as one.
struct Cluster {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Aabb bounds;
};

inline constexpr std::size_t kClusterTriangles = 256;

[[nodiscard]] std::vector<PackedFrame> pack_frames(const Primitive& primitive);
[[nodiscard]] std::vector<PackedSurface> pack_surfaces(const Primitive& primitive);
/// Weights are renormalised so that their integers sum to 65535 (all to the first joint where there is no weight);
/// empty when the primitive has none.
[[nodiscard]] std::vector<PackedInfluence> pack_influences(const Primitive& primitive);
/// Offsets of all targets: positions of target 0, (normals of target 0,) positions of target 1, …; normals for all or
/// none.
[[nodiscard]] std::vector<float> pack_morph_offsets(const Primitive& primitive, bool& has_normals);
/// Sorts triangles in space and cuts them into clusters; `indices` becomes the sorted order.
[[nodiscard]] std::vector<Cluster> build_clusters(const Primitive& primitive, std::vector<std::uint32_t>& indices);
/// Numbers vertices in the order in which `indices` first name them, and changes `indices` to match. Result: the new
/// number of each old vertex, kNone for those that are never named. `count`: the others.
[[nodiscard]] std::vector<std::uint32_t> fetch_order(std::size_t vertex_count, std::span<std::uint32_t> indices,
                                                     std::uint32_t& count);
/// The primitive's vertices in the order in which `indices` first name them, without those that they never name;
/// `indices` are changed to match. Neighbouring triangles then read neighbouring vertices, and caches that are told by
/// index do not collide. The result's own indices stay empty.
[[nodiscard]] Primitive in_fetch_order(const Primitive& primitive, std::span<std::uint32_t> indices);

}  // namespace gloam
