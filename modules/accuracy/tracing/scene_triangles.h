// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Alpha test of a surface with holes, as frames do it, except that frames sample mips: this samples mip 0 only, with
/// the texture's nearest or linear filter.
struct CutOut {
  float alpha = 1.0f;  ///< alpha of the material
  float cutoff = 0.5f;
  std::uint32_t width = 0;  ///< 0: no texture
  std::uint32_t height = 0;
  std::vector<std::uint8_t> texels;  ///< alpha channel only, rows from the top
  bool nearest = false;
  WrapMode wrap_u = WrapMode::repeat;
  WrapMode wrap_v = WrapMode::repeat;

  /// Whether the surface has a hole at `uv`, the texture coordinates after the texture transform; `vertex_alpha`: alpha
  /// of the vertex colour.
  [[nodiscard]] bool is_hole(vec2 uv, float vertex_alpha) const;
};

/// Where the attributes of a mesh's surface come from. Attributes and textures stay in SceneAssets.
struct SurfaceSource {
  std::uint32_t mesh = 0;              ///< index in SceneAssets::meshes
  std::uint32_t primitive = 0;         ///< index in Mesh::primitives
  bool mirrored = false;               ///< the front of a triangle is where its corners run clockwise
  mat3 normal_from_mesh = mat3(1.0f);  ///< to the world's axes, any length
  std::vector<vec3> normals;           ///< deformed meshes: one per position in the world's axes, instead of the above
  std::shared_ptr<const Primitive> split;  ///< with smaller triangles, in place of the mesh's own; null: none is large
};

/// Triangles with one alpha test.
struct TriangleMesh {
  std::vector<vec3> positions;         ///< relative to SceneTriangles::origin
  std::vector<std::uint32_t> indices;  ///< three per triangle, each below positions.size()
  std::uint32_t cut_out = kNone;       ///< index in SceneTriangles::cut_outs; kNone: no holes
  std::vector<vec2> uvs;               ///< for cut-outs: one per position
  std::vector<float> alphas;           ///< for cut-outs with vertex colours: one per position
  dvec3 min = dvec3(0.0);              ///< emissive meshes: bounds, world
  dvec3 max = dvec3(0.0);
  double emissive_reach_m = 0.0;  ///< emissive meshes: half the diagonal of the mesh's own box; 0 for all others
  SurfaceSource surface;
};

/// The triangles of a world.
struct SceneTriangles {
  dvec3 origin = dvec3(0.0);         ///< world
  std::vector<TriangleMesh> meshes;  ///< that cast shadows; ordered by entity index, then by primitive
  std::vector<TriangleMesh> uncast;  ///< that cast no shadows; in the same order
  std::vector<CutOut> cut_outs;

  /// Number of triangles that cast shadows.
  [[nodiscard]] std::uint64_t count() const;
  /// Hash of the origin, the triangles that cast shadows and all cut-outs.
  [[nodiscard]] std::uint64_t hash() const;
  /// The same with the triangles that cast no shadows.
  [[nodiscard]] std::uint64_t hash_of_all() const;
};

/// The triangles of MeshInstances as a frame shows them after its systems: WorldTransform in double, morphed by
/// MorphWeights, skinned by JointMatrices with up to four joints per vertex. Blended surfaces are left out. `origin`:
/// world position; none: the middle of all instances that cast shadows. Triangles of rigid meshes that are very long
/// for their distance from it are split (refined_triangles.h): their corners are floats.
[[nodiscard]] SceneTriangles gather_triangles(const World& world, const std::optional<dvec3>& origin,
                                              JobExecutor& executor, TracedInstances traced = TracedInstances::all);

}  // namespace gloam
