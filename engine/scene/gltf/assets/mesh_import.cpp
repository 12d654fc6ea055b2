// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/mesh_import.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/scene/assets/vertices.h"
#include "engine/scene/gltf/buffers/accessor_read.h"
#include "engine/scene/gltf/place.h"

namespace gloam::gltf {
namespace {

constexpr int kTriangles = 4;
constexpr int kTriangleStrip = 5;

/// Triangles of a strip or fan. Triangles with a repeated corner, which only join others, are left out.
std::vector<std::uint32_t> unroll(const std::vector<std::uint32_t>& corners, bool strip) {
  std::vector<std::uint32_t> list;
  if (corners.size() < 3) return list;
  list.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const bool swapped = strip && i % 2 == 1;
    const std::uint32_t a = strip ? corners[i] : corners[0];
    const std::uint32_t b = corners[i + (swapped ? 2 : 1)];
    const std::uint32_t c = corners[i + (swapped ? 1 : 2)];
    if (a == b || b == c || c == a) continue;
    list.insert(list.end(), {a, b, c});
  }
  return list;
}

Status read_triangles(const Document& document, const PrimitiveSource& source, Primitive& primitive) {
  std::vector<std::uint32_t>& indices = primitive.indices;
  if (source.indices == kNone) {
    indices.resize(primitive.positions.size());
    std::iota(indices.begin(), indices.end(), 0u);
  } else {
    indices.resize(document.accessors[source.indices].count);
    GLOAM_TRY(read_integers(document, source.indices, indices));
    const auto wrong = std::find_if(indices.begin(), indices.end(),
                                    [&](std::uint32_t index) { return index >= primitive.positions.size(); });
    if (wrong != indices.end())
      return fault_at(place("accessor", source.indices), "index " + std::to_string(*wrong) + " is past the " +
                                                             std::to_string(primitive.positions.size()) + " vertices");
  }
  if (source.mode != kTriangles)
    indices = unroll(indices, source.mode == kTriangleStrip);
  else
    indices.resize(indices.size() / 3 * 3);
  return {};
}

Status read_colors(const Document& document, std::uint32_t accessor, std::vector<vec4>& colors) {
  if (document.accessors[accessor].components == 4) return read_vectors(document, accessor, colors);
  std::vector<vec3> opaque;
  GLOAM_TRY(read_vectors(document, accessor, opaque));
  colors.resize(opaque.size());
  for (std::size_t i = 0; i < opaque.size(); ++i) colors[i] = vec4(opaque[i], 1.0f);
  return {};
}

/// Scales weights to sum to 1. A vertex without weights follows its first joint.
Status read_influences(const Document& document, const PrimitiveSource& source, Primitive& primitive,
                       std::uint32_t& joint_count) {
  std::vector<std::uint32_t> joints(document.accessors[source.joints].count * 4);
  GLOAM_TRY(read_integers(document, source.joints, joints));
  GLOAM_TRY(read_vectors(document, source.weights, primitive.weights));
  primitive.joints.resize(primitive.weights.size());
  for (std::size_t v = 0; v < primitive.weights.size(); ++v) {
    vec4& weights = primitive.weights[v];
    weights = glm::max(weights, vec4(0.0f));
    const double sum = double{weights.x} + weights.y + weights.z + weights.w;
    weights = sum > 0.0 ? vec4(glm::dvec4(weights) / sum) : vec4(1.0f, 0.0f, 0.0f, 0.0f);
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t joint = weights[i] > 0.0f ? joints[v * 4 + static_cast<std::size_t>(i)] : 0;
      primitive.joints[v][static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(joint);
      joint_count = std::max(joint_count, joint + 1);
    }
  }
  return {};
}

Status read_targets(const Document& document, const PrimitiveSource& source, Primitive& primitive) {
  primitive.morph_targets.resize(source.targets.size());
  for (std::size_t i = 0; i < source.targets.size(); ++i) {
    Primitive::MorphTarget& target = primitive.morph_targets[i];
    if (source.targets[i].position != kNone)
      GLOAM_TRY(read_vectors(document, source.targets[i].position, target.positions));
    else
      target.positions.resize(primitive.positions.size(), vec3(0.0f));
    if (source.targets[i].normal != kNone && source.normal != kNone)
      GLOAM_TRY(read_vectors(document, source.targets[i].normal, target.normals));
  }
  return {};
}

Status read_attributes(const Document& document, const PrimitiveSource& source, Primitive& primitive,
                       ImportedMesh& mesh) {
  GLOAM_TRY(read_vectors(document, source.position, primitive.positions));
  if (source.normal != kNone) GLOAM_TRY(read_vectors(document, source.normal, primitive.normals));
  if (source.uv0 != kNone) GLOAM_TRY(read_vectors(document, source.uv0, primitive.uv0));
  if (source.uv1 != kNone) GLOAM_TRY(read_vectors(document, source.uv1, primitive.uv1));
  if (source.color != kNone) GLOAM_TRY(read_colors(document, source.color, primitive.colors));
  if (source.joints != kNone && source.weights != kNone)
    GLOAM_TRY(read_influences(document, source, primitive, mesh.joint_count));
  return read_targets(document, source, primitive);
}

Status import_primitive(const Document& document, const PrimitiveSource& source, const std::string& where,
                        ImportedMesh& mesh) {
  if (source.position == kNone || source.mode < kTriangles) {
    mesh.warnings.push_back(where +
                            (source.position == kNone ? ": it has no positions" : ": points and lines are not drawn") +
                            ", it is left out");
    return {};
  }
  Primitive primitive;
  primitive.material = source.material;
  GLOAM_TRY(read_attributes(document, source, primitive, mesh));
  GLOAM_TRY(read_triangles(document, source, primitive));
  const TextureSlot* normal_texture =
      source.material == kNone ? nullptr : &document.materials[source.material].normal_texture;
  if (normal_texture != nullptr && normal_texture->texture == kNone) normal_texture = nullptr;
  const bool has_tangents = normal_texture != nullptr && source.tangent != kNone && source.normal != kNone;
  if (has_tangents) GLOAM_TRY(read_vectors(document, source.tangent, primitive.tangents));
  drop_unused_vertices(primitive);
  if (primitive.normals.empty())
    make_flat_normals(primitive);
  else
    mesh.replaced_normals += repair_normals(primitive);
  if (has_tangents)
    repair_tangents(primitive);
  else if (normal_texture != nullptr)
    make_tangents(primitive, *normal_texture);
  if (primitive.indices.empty()) return {};
  if (source.more_influences) mesh.warnings.push_back(where + ": of its joints the first four of a vertex are used");
  for (const vec3& position : primitive.positions) primitive.bounds.grow(position);
  mesh.mesh.bounds.grow(primitive.bounds);
  mesh.mesh.primitives.push_back(std::move(primitive));
  return {};
}

}  // namespace

Result<ImportedMesh> import_mesh(const Document& document, std::size_t index) {
  const MeshSource& source = document.meshes[index];
  const std::string where = place("mesh", index, source.name);
  ImportedMesh result;
  result.mesh.name = source.name;
  for (std::size_t i = 0; i < source.primitives.size(); ++i) {
    const std::string primitive = where + ", " + place("primitive", i);
    if (Status status = import_primitive(document, source.primitives[i], primitive, result); !status)
      return fault_at(primitive, status.error().message);
  }
  const std::size_t targets = source.primitives.empty() ? 0 : source.primitives[0].targets.size();
  result.mesh.morph_weights.resize(targets, 0.0f);
  for (std::size_t i = 0; i < source.weights.size(); ++i)
    result.mesh.morph_weights[i] = static_cast<float>(source.weights[i]);
  return result;
}

}  // namespace gloam::gltf
