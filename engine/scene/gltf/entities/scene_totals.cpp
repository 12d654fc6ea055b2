// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/scene_totals.h"

#include <string>
#include <vector>

#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

/// Sizes of one mesh, or sums of them.
struct Sizes {
  std::uint64_t primitives = 0;
  std::uint64_t triangles = 0;
  std::uint64_t morphed_vertices = 0;  ///< of primitives with morph targets
  std::uint64_t skinned_vertices = 0;  ///< of primitives with joints but no morph targets
};

/// A sum that must not exceed a limit.
struct Total {
  const char* name;
  std::uint64_t limit;
  std::uint64_t sum = 0;

  Status add(std::uint64_t more, const std::string& where) {
    sum += more;
    if (sum <= limit) return {};
    return fault_at(where, "the scene has " + std::to_string(sum) + " " + name + " up to here, at most " +
                               std::to_string(limit) + " are read");
  }
};

/// Vertices of a primitive in a stream whose parts are aligned for binding.
std::uint64_t aligned_vertices(const Primitive& primitive) {
  constexpr std::uint64_t kAlign = 64;
  return (primitive.positions.size() + kAlign - 1) / kAlign * kAlign;
}

std::uint64_t morph_floats(const Primitive& primitive) {
  return std::uint64_t{6} * primitive.positions.size() * primitive.morph_targets.size();
}

Status check_primitive_sizes(const Primitive& primitive, const std::string& where) {
  const auto check = [&](std::uint64_t count, std::uint64_t limit, const char* name) -> Status {
    if (count <= limit) return {};
    return fault_at(where, "a primitive has " + std::to_string(count) + " " + name + ", at most " +
                               std::to_string(limit) + " are read");
  };
  GLOAM_TRY(check(primitive.positions.size(), kMaxPrimitiveVertices, "vertices"));
  GLOAM_TRY(check(primitive.indices.size(), kMaxPrimitiveIndices, "indices"));
  return check(morph_floats(primitive), kMaxMorphFloats, "components of morph targets");
}

Sizes sizes_of(const Mesh& mesh) {
  Sizes sizes;
  for (const Primitive& primitive : mesh.primitives) {
    ++sizes.primitives;
    sizes.triangles += primitive.indices.size() / 3;
    if (!primitive.morph_targets.empty())
      sizes.morphed_vertices += aligned_vertices(primitive);
    else if (!primitive.joints.empty())
      sizes.skinned_vertices += aligned_vertices(primitive);
  }
  return sizes;
}

/// Sums over the meshes of the file, drawn or not.
Status check_assets(const Document& document, std::span<const Mesh> meshes) {
  Total vertices{"vertices", kMaxAssetItems};
  Total indices{"indices", kMaxAssetItems};
  Total offsets{"components of morph targets", kMaxAssetItems};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string where = place("mesh", i, document.meshes[i].name);
    for (const Primitive& primitive : meshes[i].primitives) {
      GLOAM_TRY(check_primitive_sizes(primitive, where));
      GLOAM_TRY(vertices.add(aligned_vertices(primitive), where));
      GLOAM_TRY(indices.add(primitive.indices.size(), where));
      GLOAM_TRY(offsets.add(morph_floats(primitive), where));
    }
  }
  return {};
}

}  // namespace

Status check_scene_totals(const Document& document, const SceneNodeOrder& nodes,
                          std::span<const std::uint32_t> joint_counts, std::span<const Mesh> meshes) {
  GLOAM_TRY(check_assets(document, meshes));
  std::vector<Sizes> sizes;
  for (const Mesh& mesh : meshes) sizes.push_back(sizes_of(mesh));
  Total primitives{"drawn primitives", kMaxDrawnPrimitives};
  Total triangles{"drawn triangles", kMaxDrawnTriangles};
  Total deformed{"skinned and morphed vertices", kMaxDeformedVertices};
  Total joints{"joints of skinned nodes", kMaxJoints};
  Total weights{"morph weights", kMaxMorphWeights};
  for (std::size_t i = 0; i < document.nodes.size(); ++i) {
    const NodeSource& node = document.nodes[i];
    if (!nodes.used[i] || node.mesh == kNone) continue;
    const std::string where = place("node", i, node.name);
    const Sizes& mesh = sizes[node.mesh];
    const bool skinned = node.skin != kNone && joint_counts[node.mesh] > 0;
    GLOAM_TRY(primitives.add(mesh.primitives, where));
    GLOAM_TRY(triangles.add(mesh.triangles, where));
    GLOAM_TRY(deformed.add(mesh.morphed_vertices + (skinned ? mesh.skinned_vertices : 0), where));
    GLOAM_TRY(joints.add(skinned ? document.skins[node.skin].joints.size() : 0, where));
    GLOAM_TRY(weights.add(meshes[node.mesh].morph_weights.size(), where));
  }
  return {};
}

}  // namespace gloam::gltf
