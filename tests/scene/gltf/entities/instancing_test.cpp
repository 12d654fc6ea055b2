// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/instancing.h"

#include <gmock/gmock.h>

#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::HasSubstr;

std::string instanced_node(const std::string& attributes, const std::string& more = {}) {
  return R"({"name": "tree", "mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {)" + attributes +
         "}}}" + more + "}";
}

std::string refusal_of(const GltfText& gltf) {
  Import import;
  test::import_text(gltf.text(), import);
  return import.fault();
}

TEST(Instancing, every_instance_is_a_child_entity_with_its_pose) {
  GltfText gltf;
  gltf.triangle();
  gltf.set("extensionsRequired", R"(["EXT_mesh_gpu_instancing"])");
  const std::string translation = std::to_string(gltf.floats({1, 0, 0, 0, 2, 0}, "VEC3"));
  const std::string scale = std::to_string(gltf.floats({1, 1, 1, 3, 3, 3}, "VEC3"));
  const std::string rotation = std::to_string(gltf.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 32767, 0, 0},
                                                            5122, "VEC4", R"(, "normalized": true)"));
  gltf.add("nodes", R"({"translation": [0, 0, 10], "children": [1]})");
  gltf.add("nodes", instanced_node("\"TRANSLATION\": " + translation + ", \"SCALE\": " + scale +
                                   ", \"ROTATION\": " + rotation + ", \"_ID\": " + scale));
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  ASSERT_EQ(import.info().node_entities.size(), 4u);
  EXPECT_EQ(import.info().triangles, 2u);
  EXPECT_FALSE(import.world.has<MeshInstance>(import.node(1)));
  const Entity second = import.node(3);
  EXPECT_EQ(import.world.get<Parent>(second).entity, import.node(1));
  EXPECT_TRUE(import.world.has<MeshInstance>(second));
  // Half a turn around +Y, three times as large.
  const dmat4& world = import.world.get<WorldTransform>(second).matrix;
  EXPECT_NEAR(glm::distance(dvec3(world[3]), dvec3(0, 2, 10)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(dvec3(world[0]), dvec3(-3, 0, 0)), 0.0, 1e-9);
}

TEST(Instancing, keys_of_the_mesh_are_set_on_every_instance) {
  GltfText gltf;
  gltf.triangle();
  const std::string translation = std::to_string(gltf.floats({1, 0, 0, 0, 2, 0}, "VEC3"));
  gltf.add("nodes", instanced_node("\"TRANSLATION\": " + translation, R"(, "extras": {"gloam.grass.density": 5})"));
  std::vector<Entity> set;
  KeyRegistry registry;
  SceneKey density;
  density.on = KeyElement::mesh_node;
  density.name = "gloam.grass.density";
  density.type = KeyType::number;
  density.set = [&set](KeyTarget& target, const KeyValue&) -> Status {
    set.push_back(target.entity);
    return {};
  };
  registry.add(density);
  Import import;
  test::import_text(gltf.text(), import, {}, registry);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(set, ::testing::ElementsAre(import.node(1), import.node(2)));
}

TEST(Instancing, faults_name_the_node_and_the_attribute) {
  GltfText gltf;
  gltf.triangle();
  const std::string two = std::to_string(gltf.floats({1, 0, 0, 0, 2, 0}, "VEC3"));
  const std::string one = std::to_string(gltf.floats({0, 0, 0, 0}, "VEC4"));
  GltfText differing = gltf;
  differing.add("nodes", instanced_node("\"TRANSLATION\": " + two + ", \"ROTATION\": " + one));
  EXPECT_EQ(refusal_of(differing),
            "scene.gltf: node 0 \"tree\", EXT_mesh_gpu_instancing: ROTATION (accessor 2) has 1 elements, but there are "
            "2 instances");
  GltfText lengthless = gltf;
  lengthless.add("nodes", instanced_node("\"ROTATION\": " + one));
  EXPECT_THAT(refusal_of(lengthless), HasSubstr("a rotation has no length"));
  GltfText typed = gltf;
  typed.add("nodes", instanced_node("\"SCALE\": " + one));
  EXPECT_THAT(refusal_of(typed), HasSubstr("SCALE (accessor 2) must have 3 components"));
  GltfText absent = gltf;
  absent.add("nodes", instanced_node("\"SCALE\": 9"));
  EXPECT_THAT(refusal_of(absent), HasSubstr("SCALE is 9, but the file has 3 accessors"));
}

TEST(Instancing, a_count_without_bytes_is_refused) {
  GltfText gltf;
  gltf.triangle();
  gltf.add("accessors", R"({"componentType": 5126, "type": "VEC3", "count": 4000000000})");
  gltf.add("nodes", instanced_node("\"TRANSLATION\": 1"));
  EXPECT_THAT(refusal_of(gltf),
              HasSubstr("TRANSLATION (accessor 1) has 4000000000 elements, at most 1048576 are read"));
  GltfText many;
  many.triangle();
  many.add("accessors", R"({"componentType": 5126, "type": "VEC3", "count": 1000000})");
  for (int i = 0; i < 2; ++i) many.add("nodes", instanced_node("\"TRANSLATION\": 1"));
  EXPECT_THAT(refusal_of(many), HasSubstr("node 1 \"tree\", EXT_mesh_gpu_instancing: with its instances the file has "
                                          "2000002 nodes, at most 1048576 are read"));
}

TEST(Instancing, a_skinned_mesh_is_drawn_once_with_a_warning) {
  GltfText gltf;
  gltf.triangle();
  const std::string two = std::to_string(gltf.floats({1, 0, 0, 0, 2, 0}, "VEC3"));
  gltf.add("skins", R"({"joints": [0]})");
  gltf.add("nodes", instanced_node("\"TRANSLATION\": " + two, R"(, "skin": 0)"));
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_EQ(import.info().node_entities.size(), 1u);
  EXPECT_THAT(import.info().warnings, ::testing::Contains(HasSubstr("it is drawn once")));
}

}  // namespace
}  // namespace gloam
