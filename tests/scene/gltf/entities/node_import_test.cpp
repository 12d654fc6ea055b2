// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/node_import.h"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void load(const GltfText& gltf, Import& import, const ImportOptions& options = {}) {
  test::import_text(gltf.text(), import, options);
  ASSERT_EQ(import.fault(), "");
}

dvec3 world_position(const Import& import, std::size_t node) {
  return dvec3(import.world.get<WorldTransform>(import.node(node)).matrix[3]);
}

TEST(NodeImport, every_node_of_the_scene_is_an_entity_with_its_pose_parent_and_world_transform) {
  GltfText gltf;
  gltf.add("nodes", R"({"name": "child", "translation": [1, 0, 0]})");
  gltf.add("nodes", R"({"name": "root", "translation": [0, 5, 0], "rotation": [0, 0, 2, 2], "scale": [2, 2, 2],
                        "children": [0]})");
  Import import;
  load(gltf, import);
  const Entity child = import.node(0);
  const Entity root = import.node(1);
  EXPECT_EQ(import.world.get<SourceNode>(root).index, 1u);
  EXPECT_FALSE(import.world.has<Parent>(root));
  EXPECT_EQ(import.world.get<Parent>(child).entity, root);
  EXPECT_EQ(import.world.get<Parent>(child).depth, 1u);
  EXPECT_NEAR(glm::length(import.world.get<LocalTransform>(root).rotation), 1.0, 1e-12);
  EXPECT_NEAR(glm::distance(world_position(import, 0), dvec3(0, 7, 0)), 0.0, 1e-12);
  EXPECT_EQ(import.world.resource<SceneNames>().name_of(child), "child");
}

// Hard case: scene.without_nodes
TEST(NodeImport, a_scene_without_nodes_says_so) {
  GltfText gltf;
  Import library;
  load(gltf, library);
  EXPECT_THAT(library.info().warnings, ElementsAre("scene.gltf: the file has no nodes, so there is nothing to draw"));
  gltf.add("nodes", "{}");
  gltf.add("scenes", R"({"name": "stage"})");
  gltf.add("scenes", R"({"nodes": [0]})");
  Import empty;
  load(gltf, empty);
  EXPECT_THAT(empty.info().warnings,
              ElementsAre("scene.gltf: scene 0 \"stage\" has no nodes, so there is nothing to draw"));
  Import other;
  load(gltf, other, {.animation = {}, .scene = 1});
  EXPECT_THAT(other.info().warnings, IsEmpty());
}

TEST(NodeImport, only_the_chosen_scene_becomes_entities) {
  GltfText gltf;
  for (int i = 0; i < 3; ++i) gltf.add("nodes", "{}");
  gltf.add("scenes", R"({"nodes": [0], "name": "first"})");
  gltf.add("scenes", R"({"nodes": [1], "name": "second"})");
  gltf.set("scene", "1");
  Import by_default;
  load(gltf, by_default);
  EXPECT_EQ(by_default.info().name, "second");
  EXPECT_EQ(by_default.node(0), kNoEntity);
  EXPECT_NE(by_default.node(1), kNoEntity);
  EXPECT_EQ(by_default.node(2), kNoEntity);
  EXPECT_EQ(by_default.world.entity_count(), 1u);
  Import by_choice;
  load(gltf, by_choice, {.scene = 0});
  EXPECT_EQ(by_choice.info().name, "first");
  Import absent;
  test::import_text(gltf.text(), absent, {.scene = 2});
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.result.error().kind, ErrorKind::usage);
  EXPECT_THAT(absent.fault(), HasSubstr("scene 2 is asked for, but there are 2"));
}

TEST(NodeImport, without_scenes_all_roots_are_taken) {
  GltfText gltf;
  gltf.add("nodes", R"({"children": [2]})");
  gltf.add("nodes", "{}");
  gltf.add("nodes", "{}");
  Import import;
  load(gltf, import);
  EXPECT_EQ(import.world.entity_count(), 3u);
}

TEST(NodeImport, a_matrix_that_is_a_pose_becomes_one_and_a_sheared_one_stays) {
  GltfText gltf;
  // Columns: x to −2z, y to 3y, z to −4x (a mirrored quarter turn); translation (1, 2, 3).
  gltf.add("nodes", R"({"matrix": [0,0,-2,0, 0,3,0,0, -4,0,0,0, 1,2,3,1]})");
  gltf.add("nodes", R"({"matrix": [1,0,0,0, 0.5,1,0,0, 0,0,1,0, 7,8,9,1]})");
  gltf.add("nodes", R"({"matrix": [0,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})");
  Import import;
  load(gltf, import);
  EXPECT_FALSE(import.world.has<LocalMatrix>(import.node(0)));
  const auto& pose = import.world.get<LocalTransform>(import.node(0));
  EXPECT_EQ(pose.translation, dvec3(1, 2, 3));
  EXPECT_NEAR(std::fabs(pose.scale.x * pose.scale.y * pose.scale.z), 24.0, 1e-9);
  const dmat4& world = import.world.get<WorldTransform>(import.node(0)).matrix;
  EXPECT_NEAR(glm::distance(world * dvec4(1, 1, 1, 1), dvec4(-3, 5, 1, 1)), 0.0, 1e-9);
  ASSERT_TRUE(import.world.has<LocalMatrix>(import.node(1)));
  EXPECT_EQ(import.world.get<LocalMatrix>(import.node(1)).matrix[1][0], 0.5);
  EXPECT_EQ(world_position(import, 1), dvec3(7, 8, 9));
  EXPECT_TRUE(import.world.has<LocalMatrix>(import.node(2)));
}

TEST(NodeImport, a_hundred_thousand_nodes_in_one_chain_do_not_overflow_the_stack) {
  constexpr int kDepth = 100000;
  std::string nodes;
  for (int i = 0; i < kDepth; ++i)
    nodes += R"({"translation": [1, 0, 0], "children": [)" + std::to_string(i + 1) + "]},\n";
  const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + "{}]}";
  Import import;
  test::import_text(text, import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_EQ(world_position(import, kDepth), dvec3(kDepth, 0, 0));
  EXPECT_EQ(import.world.get<Parent>(import.node(kDepth)).depth, static_cast<std::uint32_t>(kDepth));
}

TEST(NodeImport, cameras_are_perspective_or_orthographic_and_named_after_their_node) {
  GltfText gltf;
  gltf.add("cameras", R"({"type": "perspective", "name": "lens", "perspective": {"yfov": 0.5, "znear": 0.25}})");
  gltf.add("cameras", R"({"type": "orthographic",
                          "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 50}})");
  gltf.add("nodes", R"({"name": "top", "camera": 1})");
  gltf.add("nodes", R"({"camera": 0})");
  Import import;
  load(gltf, import);
  EXPECT_THAT(import.info().cameras, ElementsAre(import.node(0), import.node(1)));
  const auto& top = import.world.get<Camera>(import.node(0));
  EXPECT_TRUE(top.orthographic);
  EXPECT_EQ(top.half_width_m, 4.0f);
  EXPECT_EQ(top.half_height_m, 3.0f);
  EXPECT_EQ(top.far_m, 50.0f);
  const auto& lens = import.world.get<Camera>(import.node(1));
  EXPECT_FALSE(lens.orthographic);
  EXPECT_EQ(lens.fov_y, 0.5f);
  EXPECT_EQ(lens.near_m, 0.25f);
  EXPECT_EQ(lens.far_m, 0.0f);
  EXPECT_THAT(import.world.resource<SceneNames>().names("camera"), ElementsAre("top", "lens"));
}

TEST(NodeImport, a_camera_and_a_mesh_node_may_share_a_name) {
  GltfText gltf;
  gltf.triangle();
  gltf.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}})");
  gltf.add("nodes", R"({"name": "lawn", "mesh": 0})");
  gltf.add("nodes", R"({"name": "lawn", "camera": 0})");
  Import import;
  load(gltf, import);
  const auto& names = import.world.resource<SceneNames>();
  EXPECT_EQ(*names.find("mesh", "lawn"), import.node(0));
  EXPECT_EQ(*names.find("camera", "lawn"), import.node(1));
  EXPECT_FALSE(names.find("node", "lawn").ok());
}

TEST(NodeImport, morph_weights_come_from_the_node_then_from_the_mesh) {
  GltfText gltf;
  const std::string positions = std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  gltf.add("meshes", R"({"weights": [0.5], "primitives": [{"attributes": {"POSITION": )" + positions +
                         R"(}, "targets": [{"POSITION": )" + positions + "}]}]}");
  gltf.add("nodes", R"({"mesh": 0})");
  gltf.add("nodes", R"({"mesh": 0, "weights": [0.75]})");
  Import import;
  load(gltf, import);
  const auto weight = [&](std::size_t node) {
    const auto& morph = import.world.get<MorphInstance>(import.node(node));
    EXPECT_EQ(morph.count, 1u);
    return import.world.resource<MorphWeights>().values[morph.first];
  };
  EXPECT_EQ(weight(0), 0.5f);
  EXPECT_EQ(weight(1), 0.75f);
}

TEST(NodeImport, a_skin_on_a_mesh_without_joints_moves_nothing) {
  GltfText gltf;
  gltf.triangle();
  gltf.add("skins", R"({"joints": [0]})");
  gltf.add("nodes", R"({"mesh": 0, "skin": 0})");
  Import import;
  load(gltf, import);
  EXPECT_EQ(import.world.get<MeshInstance>(import.node(0)).skin, ~0u);
  EXPECT_THAT(import.info().warnings, ElementsAre(HasSubstr("node 0: its mesh has no joints")));
}

}  // namespace
}  // namespace gloam
