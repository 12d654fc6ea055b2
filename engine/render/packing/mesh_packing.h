// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/assets.h"

namespace gloam {

/// Stream 1 of a vertex: attributes that deformation changes. Octahedral snorm16 codes; the lowest bit of the tangent's
/// second coordinate holds the handedness (1 = −1).
struct PackedFrame {
  std::uint32_t normal = 0;
  std::uint32_t tangent = 0;
};

/// Stream 2 of a vertex: attributes that deformation does not change.
struct PackedSurface {
  vec2 uv0 = vec2(0.0f);
  vec2 uv1 = vec2(0.0f);
  std::array<std::uint16_t, 4> color = {0x3C00, 0x3C00, 0x3C00, 0x3C00};  ///< RGBA in 0…1, half floats
};

/// Four joints of 16 bits, four unorm16 weights.
struct PackedInfluence {
  std::uint32_t joints01 = 0;
  std::uint32_t joints23 = 0;
  std::uint32_t weights01 = 0;
  std::uint32_t weights23 = 0;
};

/// Consecutive triangles that lie near each other and are culled together.
struct Cluster {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Aabb bounds;
};

inline constexpr std::size_t kClusterTriangles = 256;

[[nodiscard]] std::vector<PackedFrame> pack_frames(const Primitive& primitive);
[[nodiscard]] std::vector<PackedSurface> pack_surfaces(const Primitive& primitive);
/// One per vertex; empty if the primitive has no joints or weights. Weights are renormalised so that their integers sum
/// to 65535; a vertex without weights follows its first joint.
[[nodiscard]] std::vector<PackedInfluence> pack_influences(const Primitive& primitive);
/// Offsets of all targets: positions of target 0, (normals of target 0,) positions of target 1, …. Normals are packed
/// only if all targets have them (`has_normals`).
[[nodiscard]] std::vector<float> pack_morph_offsets(const Primitive& primitive, bool& has_normals);
/// Sorts triangles in space and cuts them into clusters of kClusterTriangles. Writes the sorted triangles to `indices`.
[[nodiscard]] std::vector<Cluster> build_clusters(const Primitive& primitive, std::vector<std::uint32_t>& indices);
/// The same for triangles that are in `indices` already.
[[nodiscard]] std::vector<Cluster> sort_into_clusters(std::span<const vec3> positions,
                                                      std::vector<std::uint32_t>& indices);
/// Renumbers vertices in the order in which `indices` first use them, and changes `indices` to match. Returns the new
/// number of each old vertex, kNone for unused vertices. `count`: number of used vertices.
[[nodiscard]] std::vector<std::uint32_t> fetch_order(std::size_t vertex_count, std::span<std::uint32_t> indices,
                                                     std::uint32_t& count);
/// A copy of the primitive with its vertices in the order in which `indices` first use them, without unused vertices;
/// changes `indices` to match. Neighbouring triangles then read neighbouring vertices, and caches that are addressed by
/// vertex index have no conflicts. The copy's own indices stay empty.
[[nodiscard]] Primitive in_fetch_order(const Primitive& primitive, std::span<std::uint32_t> indices);

}  // namespace gloam
