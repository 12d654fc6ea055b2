// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Where a surface has holes: its alpha, as a frame tests it. Frames filter with mips; here the image itself is looked
/// at, between its texels as the sampler says.
struct CutOut {
  float alpha = 1.0f;  ///< of the material
  float cutoff = 0.5f;
  std::uint32_t width = 0;  ///< 0: no texture
  std::uint32_t height = 0;
  std::vector<std::uint8_t> texels;  ///< alpha alone, rows from the top
  bool nearest = false;
  WrapMode wrap_u = WrapMode::repeat;
  WrapMode wrap_v = WrapMode::repeat;

  /// Whether there is a hole. uv: of the texture, its transform applied; vertex_alpha: of vertex colours.
  [[nodiscard]] bool is_hole(vec2 uv, float vertex_alpha) const;
};

/// Triangles that are alike in what they let through.
struct TriangleMesh {
  std::vector<vec3> positions;         ///< relative to SceneTriangles::origin
  std::vector<std::uint32_t> indices;  ///< three a triangle, below positions.size()
  std::uint32_t cut_out = kNone;       ///< of SceneTriangles::cut_outs; kNone: without holes
  std::vector<vec2> uvs;               ///< of cut-outs, one a position
  std::vector<float> alphas;           ///< of cut-outs with vertex colours, one a position
};

/// What of a world casts shadows.
struct SceneTriangles {
  dvec3 origin = dvec3(0.0);         ///< world
  std::vector<TriangleMesh> meshes;  ///< ordered by entity index, then by primitive
  std::vector<CutOut> cut_outs;

  [[nodiscard]] std::uint64_t count() const;
  /// Another one for other triangles.
  [[nodiscard]] std::uint64_t hash() const;
};

/// The triangles of all MeshInstances as a frame shows them after its systems: WorldTransform in double, morphed by
/// MorphWeights, skinned by JointMatrices with up to four joints a vertex. Blended surfaces are left out. origin:
/// world; none: the middle of all there is.
[[nodiscard]] SceneTriangles gather_triangles(const World& world, const std::optional<dvec3>& origin,
                                              JobExecutor& executor);

}  // namespace gloam
