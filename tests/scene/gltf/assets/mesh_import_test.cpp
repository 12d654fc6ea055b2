// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/mesh_import.h"

#include <gmock/gmock.h>

#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string attribute(const char* name, int accessor) {
  return "\"" + std::string(name) + "\": " + std::to_string(accessor);
}

/// Imports a file whose only node draws mesh 0, and returns the file's only primitive.
const Primitive& only_primitive(GltfText& gltf, Import& import) {
  gltf.add("nodes", R"({"mesh": 0})");
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(), "");
  static const Primitive kNothing;
  if (!import.ok() || import.world.resource<SceneAssets>().meshes[0].primitives.size() != 1) {
    ADD_FAILURE() << "the mesh has not one primitive";
    return kNothing;
  }
  return import.world.resource<SceneAssets>().meshes[0].primitives[0];
}

TEST(MeshImport, a_triangle_without_normals_is_flat) {
  GltfText gltf;
  gltf.triangle();
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
  EXPECT_THAT(primitive.normals, ElementsAre(vec3(0, 0, 1), vec3(0, 0, 1), vec3(0, 0, 1)));
  EXPECT_THAT(primitive.tangents, IsEmpty());
  EXPECT_EQ(primitive.material, kNone);
  EXPECT_EQ(primitive.bounds.min, vec3(0, 0, 0));
  EXPECT_EQ(primitive.bounds.max, vec3(1, 1, 0));
  EXPECT_EQ(import.info().triangles, 1u);
}

TEST(MeshImport, missing_normals_unshare_the_vertices_of_an_indexed_mesh) {
  GltfText gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  const int indices = gltf.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 3, 1}, 5123, "SCALAR");
  gltf.mesh(attribute("POSITION", positions), ", \"indices\": " + std::to_string(indices));
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  ASSERT_EQ(primitive.positions.size(), 6u);
  EXPECT_EQ(primitive.normals[0], vec3(0, 0, 1));
  EXPECT_EQ(primitive.normals[3], vec3(0, 1, 0));
  EXPECT_EQ(primitive.positions[4], vec3(0, 0, 1));
}

TEST(MeshImport, a_triangle_without_area_points_up) {
  GltfText gltf;
  gltf.mesh(attribute("POSITION", gltf.floats({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3")));
  Import import;
  EXPECT_EQ(only_primitive(gltf, import).normals[0], vec3(0, 1, 0));
}

TEST(MeshImport, strips_alternate_and_fans_turn_around_their_first_vertex) {
  for (const int mode : {5, 6}) {
    GltfText gltf;
    const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    const int normals = gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    gltf.mesh(attribute("POSITION", positions) + ", " + attribute("NORMAL", normals),
              ", \"mode\": " + std::to_string(mode));
    Import import;
    const Primitive& primitive = only_primitive(gltf, import);
    if (mode == 5) {
      EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2, 1, 3, 2));
    } else {
      EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2, 0, 2, 3));
    }
  }
}

TEST(MeshImport, points_and_lines_are_left_out_with_a_warning) {
  GltfText gltf;
  gltf.mesh(attribute("POSITION", gltf.floats(kSquare, "VEC3")), ", \"mode\": 1");
  gltf.add("nodes", R"({"mesh": 0})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(import.world.resource<SceneAssets>().meshes[0].primitives, IsEmpty());
  EXPECT_THAT(import.info().warnings, ElementsAre(HasSubstr("mesh 0, primitive 0: points and lines are not drawn")));
  EXPECT_EQ(import.log, import.info().warnings);
}

TEST(MeshImport, normals_become_unit_length_and_lengthless_ones_take_the_weighted_normal_of_their_faces) {
  GltfText gltf;
  // Vertex 0 lies in both triangles; the first has twice the second's area.
  const int positions = gltf.floats({0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  const int normals = gltf.floats({0, 0, 0, 0, 0, 5, 0, 0, 1, 0, 3, 0}, "VEC3");
  const int indices = gltf.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, 5121, "SCALAR");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("NORMAL", normals),
            ", \"indices\": " + std::to_string(indices));
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  const vec3 expected = glm::normalize(vec3(1, 0, 2));
  EXPECT_NEAR(glm::distance(primitive.normals[0], expected), 0.0f, 1e-6f);
  EXPECT_EQ(primitive.normals[1], vec3(0, 0, 1));
  EXPECT_EQ(primitive.normals[3], vec3(0, 1, 0));
  EXPECT_EQ(import.info().replaced_normals, 1u);
  EXPECT_THAT(import.info().warnings, IsEmpty());
}

TEST(MeshImport, vertices_that_no_index_names_are_dropped) {
  GltfText gltf;
  const int positions = gltf.floats({9, 9, 9, 0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int normals = gltf.floats(std::vector<float>(15, 1.0f), "VEC3");
  const int indices = gltf.accessor(std::vector<std::uint32_t>{1, 3, 4}, 5125, "SCALAR");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("NORMAL", normals),
            ", \"indices\": " + std::to_string(indices));
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  EXPECT_THAT(primitive.positions, ElementsAre(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)));
  EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(primitive.bounds.max, vec3(1, 1, 0));
}

TEST(MeshImport, interleaved_attributes_follow_their_stride) {
  GltfText gltf;
  std::vector<float> interleaved;
  for (int i = 0; i < 3; ++i)
    interleaved.insert(interleaved.end(), {i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f, 0, 0, 0, 1});
  const int view = gltf.view(std::as_bytes(std::span(interleaved)), R"(, "byteStride": 24)");
  const std::string of_view = R"({"bufferView": )" + std::to_string(view) + R"(, "componentType": 5126, "count": 3, )";
  const int positions = gltf.add("accessors", of_view + R"("type": "VEC3"})");
  const int normals = gltf.add("accessors", of_view + R"("byteOffset": 12, "type": "VEC3"})");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("NORMAL", normals));
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  EXPECT_THAT(primitive.positions, ElementsAre(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)));
  EXPECT_THAT(primitive.normals, ElementsAre(vec3(0, 0, 1), vec3(0, 0, 1), vec3(0, 0, 1)));
}

TEST(MeshImport, normalised_integers_are_fractions) {
  GltfText gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int uv = gltf.accessor(std::vector<std::uint16_t>{0, 65535, 32768, 0, 13107, 65535}, 5123, "VEC2",
                               R"(, "normalized": true)");
  const int colors = gltf.accessor(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 255, 0, 102, 0, 0, 0, 0}, 5121, "VEC4",
                                   R"(, "normalized": true)");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("TEXCOORD_0", uv) + ", " +
            attribute("COLOR_0", colors));
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  ASSERT_EQ(primitive.uv0.size(), 3u);
  EXPECT_EQ(primitive.uv0[0], vec2(0, 1));
  EXPECT_NEAR(primitive.uv0[2].x, 0.2f, 1e-6f);
  ASSERT_EQ(primitive.colors.size(), 3u);
  EXPECT_NEAR(glm::distance(primitive.colors[0], vec4(1, 0, 0.2f, 1)), 0.0f, 1e-6f);
}

TEST(MeshImport, colours_without_alpha_are_opaque) {
  GltfText gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int colors = gltf.floats(std::vector<float>(9, 0.5f), "VEC3");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("COLOR_0", colors));
  Import import;
  EXPECT_THAT(only_primitive(gltf, import).colors, ::testing::Each(vec4(0.5f, 0.5f, 0.5f, 1.0f)));
}

TEST(MeshImport, sparse_accessors_replace_elements_with_and_without_a_view_below) {
  for (const bool has_view : {true, false}) {
    GltfText gltf;
    const int indices = gltf.view_of(std::vector<std::uint16_t>{1, 2});
    const int values = gltf.view_of(std::vector<float>{1, 0, 0, 0, 1, 0});
    const int base = gltf.view_of(std::vector<float>(9, 0.0f));
    const int positions = gltf.add(
        "accessors", "{" + (has_view ? "\"bufferView\": " + std::to_string(base) + ", " : std::string()) +
                         R"("componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 2, )" +
                         R"("indices": {"bufferView": )" + std::to_string(indices) +
                         R"(, "componentType": 5123}, "values": {"bufferView": )" + std::to_string(values) + "}}}");
    gltf.mesh(attribute("POSITION", positions));
    Import import;
    EXPECT_THAT(only_primitive(gltf, import).positions, ElementsAre(vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)));
  }
}

TEST(MeshImport, joint_weights_sum_up_to_one) {
  GltfText gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int joints = gltf.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 9, 0, 0, 0, 0, 0, 0}, 5121, "VEC4");
  const int weights = gltf.floats({1, 3, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  gltf.mesh(attribute("POSITION", positions) + ", " + attribute("JOINTS_0", joints) + ", " +
            attribute("WEIGHTS_0", weights));
  gltf.add("nodes", R"({"mesh": 0, "skin": 0})");
  gltf.add("skins", R"({"joints": [1, 2]})");
  gltf.add("nodes", "{}");
  gltf.add("nodes", "{}");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  const Primitive& primitive = import.world.resource<SceneAssets>().meshes[0].primitives[0];
  EXPECT_THAT(primitive.weights, ElementsAre(vec4(0.25f, 0.75f, 0, 0), vec4(1, 0, 0, 0), vec4(1, 0, 0, 0)));
  // A joint without a weight moves nothing and need not exist.
  EXPECT_THAT(primitive.joints[1], ElementsAre(1, 0, 0, 0));
  EXPECT_EQ(import.world.get<MeshInstance>(import.node(0)).skin, 0u);
}

TEST(MeshImport, morph_targets_keep_their_offsets_and_default_weights) {
  GltfText gltf;
  const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int normals = gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int offsets = gltf.floats({0, 0, 5, 0, 0, 6, 0, 0, 7}, "VEC3");
  gltf.add("meshes", R"({"weights": [0.5, 0.25], "primitives": [{"attributes": {)" + attribute("POSITION", positions) +
                         ", " + attribute("NORMAL", normals) + R"(}, "targets": [{)" + attribute("POSITION", offsets) +
                         "}, {" + attribute("NORMAL", offsets) + "}]}]}");
  Import import;
  const Primitive& primitive = only_primitive(gltf, import);
  ASSERT_EQ(primitive.morph_targets.size(), 2u);
  EXPECT_EQ(primitive.morph_targets[0].positions[2], vec3(0, 0, 7));
  EXPECT_THAT(primitive.morph_targets[0].normals, IsEmpty());
  EXPECT_EQ(primitive.morph_targets[1].positions[2], vec3(0, 0, 0));
  EXPECT_EQ(primitive.morph_targets[1].normals[0], vec3(0, 0, 5));
  EXPECT_THAT(import.world.resource<SceneAssets>().meshes[0].morph_weights, ElementsAre(0.5f, 0.25f));
}

}  // namespace
}  // namespace gloam
