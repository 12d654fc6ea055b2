// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/mesh_builder.h"

#include <gtest/gtest.h>

#include "engine/scene/assets/check.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// Two triangles that share an edge: one in the plane z = 0, one in the plane x = 0 with twice its area.
Primitive corner() {
  Primitive primitive;
  primitive.positions = {vec3(0.0f), vec3(0.0f, 1.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 2.0f)};
  primitive.indices = {0, 2, 1, 0, 1, 3};
  return primitive;
}

TEST(MeshBuilder, a_shared_vertex_gets_the_mean_normal_of_its_faces_by_area) {
  Primitive primitive = corner();
  complete_primitive(primitive);
  const vec3 mean = glm::normalize(vec3(2.0f, 0.0f, 1.0f));
  EXPECT_LT(glm::distance(primitive.normals[0], mean), 1e-6f);
  EXPECT_LT(glm::distance(primitive.normals[2], vec3(0.0f, 0.0f, 1.0f)), 1e-6f);
  EXPECT_LT(glm::distance(primitive.normals[3], vec3(1.0f, 0.0f, 0.0f)), 1e-6f);
}

TEST(MeshBuilder, triangles_without_indices_are_flat) {
  Primitive primitive;
  const Primitive shared = corner();
  for (const std::uint32_t index : shared.indices) primitive.positions.push_back(shared.positions[index]);
  complete_primitive(primitive);
  ASSERT_EQ(primitive.indices.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(primitive.normals[i], vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(primitive.normals[3 + i], vec3(1.0f, 0.0f, 0.0f));
  }
}

TEST(MeshBuilder, keeps_what_is_there_and_computes_bounds) {
  Primitive primitive = corner();
  primitive.normals.assign(4, vec3(0.0f, 1.0f, 0.0f));
  complete_primitive(primitive);
  EXPECT_EQ(primitive.normals, std::vector<vec3>(4, vec3(0.0f, 1.0f, 0.0f)));
  EXPECT_EQ(primitive.bounds.min, vec3(0.0f));
  EXPECT_EQ(primitive.bounds.max, vec3(1.0f, 1.0f, 2.0f));
}

TEST(MeshBuilder, tangents_follow_u_where_the_material_has_a_normal_texture) {
  SceneAssets assets;
  assets.images.push_back({.name = "", .width = 1, .height = 1, .rgba = std::vector<std::uint8_t>(4)});
  assets.textures.push_back({.name = "", .image = 0});
  assets.materials.resize(2);
  assets.materials[1].normal_texture.texture = 0;
  Mesh mesh;
  for (const std::uint32_t material : {0u, 1u}) {
    Primitive& primitive = mesh.primitives.emplace_back();
    primitive.positions = {vec3(0.0f), vec3(0.0f, 1.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f)};
    primitive.uv0 = {vec2(0.0f), vec2(1.0f, 0.0f), vec2(0.0f, 1.0f)};
    primitive.material = material;
  }
  complete_mesh(mesh, assets);
  EXPECT_TRUE(mesh.primitives[0].tangents.empty());
  ASSERT_EQ(mesh.primitives[1].tangents.size(), 3u);
  EXPECT_LT(glm::distance(vec3(mesh.primitives[1].tangents[0]), vec3(0.0f, 1.0f, 0.0f)), 1e-6f);
  EXPECT_FALSE(mesh.bounds.empty());
  assets.meshes.push_back(std::move(mesh));
  EXPECT_EQ(asset_fault(assets), "");
}

TEST(MeshBuilder, wrong_streams_assert) {
  Primitive primitive = corner();
  primitive.indices.push_back(0);
  EXPECT_ASSERT(complete_primitive(primitive), "three indices for each triangle");
  primitive = corner();
  primitive.indices[0] = 4;
  EXPECT_ASSERT(complete_primitive(primitive), "each index is less than the number of positions");
  primitive = corner();
  primitive.normals.resize(2);
  EXPECT_ASSERT(complete_primitive(primitive), "a normal for each position");
}

}  // namespace
}  // namespace gloam
