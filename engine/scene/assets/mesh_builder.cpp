// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/mesh_builder.h"

#include <algorithm>
#include <numeric>

#include "engine/core/assert.h"
#include "engine/scene/assets/vertices.h"

namespace gloam {

void complete_primitive(Primitive& primitive, const TextureSlot* normal_texture) {
  const std::size_t vertices = primitive.positions.size();
  if (primitive.indices.empty()) {
    primitive.indices.resize(vertices);
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0u);
  }
  GLOAM_ASSERT(primitive.indices.size() % 3 == 0, "a primitive has three indices for each triangle");
  GLOAM_ASSERT(std::ranges::all_of(primitive.indices, [&](std::uint32_t index) { return index < vertices; }),
               "each index is less than the number of positions");
  GLOAM_ASSERT(primitive.normals.empty() || primitive.normals.size() == vertices,
               "a primitive has a normal for each position, or none");
  primitive.normals.resize(vertices, vec3(0.0f));
  static_cast<void>(repair_normals(primitive));
  if (normal_texture != nullptr && primitive.tangents.empty()) {
    const auto& uv = normal_texture->uv_set == 0 ? primitive.uv0 : primitive.uv1;
    GLOAM_ASSERT(uv.empty() || uv.size() == vertices,
                 "a primitive has a texture coordinate for each position, or none");
    if (!uv.empty()) make_tangents(primitive, *normal_texture);
  }
  primitive.bounds = {};
  for (const vec3& position : primitive.positions) primitive.bounds.grow(position);
}

void complete_mesh(Mesh& mesh, const SceneAssets& assets) {
  mesh.bounds = {};
  for (Primitive& primitive : mesh.primitives) {
    const bool has_material = primitive.material < assets.materials.size();
    const TextureSlot* slot = has_material ? &assets.materials[primitive.material].normal_texture : nullptr;
    complete_primitive(primitive, slot != nullptr && slot->texture != kNone ? slot : nullptr);
    mesh.bounds.grow(primitive.bounds);
  }
}

}  // namespace gloam
