// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/entities/key_import.h"

#include <gmock/gmock.h>

#include "engine/scene/assets.h"
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

std::string fault_of(const GltfText& gltf, const KeyRegistry& registry = test::light_registry()) {
  Import import;
  test::import_text(gltf.text(), import, {}, registry);
  if (!import.ok()) {
    EXPECT_EQ(import.result.error().kind, ErrorKind::input);
  }
  return import.fault();
}

std::string fault_of_node(const std::string& node) {
  GltfText gltf;
  gltf.triangle();
  gltf.add("nodes", node);
  return fault_of(gltf);
}

TEST(KeyImport, scene_and_material_keys_are_set) {
  GltfText gltf;
  gltf.add("materials", R"({"extras": {"gloam.subsurface": 1, "gloam.reflectivity": 0.25}})");
  gltf.add("scenes", R"({"extras": {"gloam.sky.zenith": [0.1, 0.2, 0.3], "gloam.exposure": -3}})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_TRUE(import.world.resource<SceneAssets>().materials[0].subsurface);
  EXPECT_EQ(import.world.resource<SceneAssets>().materials[0].reflectivity, 0.25f);
  EXPECT_EQ(import.world.resource<SceneEnvironment>().sky_zenith, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(import.world.resource<SceneEnvironment>().exposure_ev100, -3.0f);
}

// Hard case: reflections.no_roughness
TEST(KeyImport, a_material_that_says_how_much_it_reflects_and_nothing_of_roughness_is_a_mirror) {
  struct Case {
    const char* material;
    float roughness;
  };
  const Case cases[] = {
      {R"({"extras": {"gloam.reflectivity": 0.9}})", 0.0f},
      {R"({"pbrMetallicRoughness": {"metallicFactor": 0}, "extras": {"gloam.reflectivity": 0.9}})", 0.0f},
      {R"({"extras": {"gloam.reflectivity": 0}})", 1.0f},
      {R"({"pbrMetallicRoughness": {"metallicFactor": 1}})", 1.0f},
      {R"({"pbrMetallicRoughness": {"roughnessFactor": 1}, "extras": {"gloam.reflectivity": 0.9}})", 1.0f},
      {R"({"pbrMetallicRoughness": {"roughnessFactor": 0.3}, "extras": {"gloam.reflectivity": 0.9}})", 0.3f}};
  for (const Case& given : cases) {
    GltfText gltf;
    gltf.add("materials", given.material);
    Import import;
    test::import_text(gltf.text(), import);
    ASSERT_EQ(import.fault(), "") << given.material;
    EXPECT_EQ(import.world.resource<SceneAssets>().materials[0].roughness, given.roughness) << given.material;
  }
}

TEST(KeyImport, extinction_lengths_default_to_five_millimetres_of_the_file) {
  for (const auto& [scale, length] : {std::pair("1", 0.005f), std::pair("0.01", 0.5f), std::pair("1000", 0.000005f)}) {
    GltfText gltf;
    gltf.add("materials", R"({"extras": {"gloam.subsurface": true}})");
    gltf.add("materials", R"({"extras": {"gloam.subsurface": true, "gloam.subsurface.extinction": 0.25}})");
    gltf.add("materials", R"({"extras": {"gloam.subsurface.extinction": 0.25}})");
    gltf.add("scenes", std::string(R"({"extras": {"gloam.scale": )") + scale + "}}");
    Import import;
    test::import_text(gltf.text(), import);
    ASSERT_EQ(import.fault(), "");
    const std::vector<Material>& materials = import.world.resource<SceneAssets>().materials;
    EXPECT_FLOAT_EQ(extinction_length(materials[0]), length) << scale;
    EXPECT_EQ(extinction_length(materials[1]), 0.25f) << "stated in units of the file";
    EXPECT_EQ(extinction_length(materials[2]), 0.0f) << "not a subsurface material";
  }
}

TEST(KeyImport, keys_of_scenes_that_are_not_chosen_are_checked_and_not_set) {
  GltfText gltf;
  gltf.add("scenes", "{}");
  gltf.add("scenes", R"({"extras": {"gloam.exposure": 5}})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_FALSE(import.world.resource<SceneEnvironment>().has_exposure);
  gltf.add("scenes", R"({"extras": {"gloam.exposure": "bright"}})");
  EXPECT_THAT(fault_of(gltf), HasSubstr("scene 2: gloam.exposure must be a number"));
}

TEST(KeyImport, other_members_of_extras_are_ignored) {
  EXPECT_EQ(fault_of_node(R"({"extras": {"prop": "x", "gloam": 1, "nested": {"gloam.light.width": 1}}})"), "");
  EXPECT_EQ(fault_of_node(R"({"extras": [1, 2, 3]})"), "");
  EXPECT_EQ(fault_of_node(R"({"extras": null})"), "");
}

// Hard case: scene.wrong_type
TEST(KeyImport, a_wrong_type_names_file_node_key_and_value) {
  EXPECT_EQ(fault_of_node(R"({"name": "torch-03", "extensions": {"KHR_lights_punctual": {"light": 0}},
                              "extras": {"gloam.light.width": "wide"}})"),
            "scene.gltf: node 0 \"torch-03\": gloam.light.width must be a number ≥ 0 m, is \"wide\"");
}

// Hard case: scene.out_of_range
TEST(KeyImport, a_value_out_of_range_or_null_is_refused) {
  EXPECT_THAT(fault_of_node(R"({"extensions": {"KHR_lights_punctual": {"light": 0}},
                                "extras": {"gloam.light.width": -1}})"),
              HasSubstr("must be a number ≥ 0 m, is -1"));
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.closeup": null}})"), HasSubstr("must be true or false, is null"));
}

// Hard case: scene.unknown_key
TEST(KeyImport, an_unknown_key_is_refused_with_the_nearest_known_one) {
  EXPECT_EQ(fault_of_node(R"({"name": "a", "extras": {"gloam.closeups": true}})"),
            "scene.gltf: node 0 \"a\": gloam.closeups is not a known key, did you mean gloam.closeup?");
  EXPECT_EQ(fault_of_node(R"({"extras": {"gloam.zzzzzzzzzzzzzz": true}})"),
            "scene.gltf: node 0: gloam.zzzzzzzzzzzzzz is not a known key");
}

// Hard case: scene.wrong_element
TEST(KeyImport, a_key_on_the_wrong_element_is_refused) {
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.light.width": 1}})"),
              HasSubstr("node 0: gloam.light.width belongs on a node with a light"));
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.grass.density": 1}})"), HasSubstr("belongs on a node with a mesh"));
  EXPECT_EQ(fault_of_node(R"({"mesh": 0, "extras": {"gloam.grass.density": 1}})"), "");
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.dof.focus": 1}})"), HasSubstr("belongs on a node with a camera"));
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.exposure": 1}})"), HasSubstr("belongs on a scene"));
  EXPECT_THAT(fault_of_node(R"({"extras": {"gloam.subsurface": true}})"), HasSubstr("belongs on a material"));
  GltfText gltf;
  gltf.add("materials", R"({"name": "m", "extras": {"gloam.closeup": true}})");
  EXPECT_EQ(fault_of(gltf), "scene.gltf: material 0 \"m\": gloam.closeup belongs on a node");
}

TEST(KeyImport, keys_on_what_takes_none_are_refused) {
  GltfText mesh;
  mesh.add("meshes", R"({"primitives": [], "extras": {"gloam.grass.density": 1}})");
  EXPECT_EQ(fault_of(mesh), "scene.gltf: mesh 0: gloam.grass.density belongs on a node with a mesh");
  GltfText root;
  root.set("extras", R"({"gloam.exposure": 1})");
  EXPECT_THAT(fault_of(root), HasSubstr("gloam.exposure belongs on a scene"));
  GltfText light;
  light.set("extensions", R"({"KHR_lights_punctual": {"lights": [{"extras": {"gloam.light.width": 1}}]}})");
  EXPECT_THAT(fault_of(light), HasSubstr("gloam.light.width belongs on a node with a light"));
}

TEST(KeyImport, a_setters_fault_gets_its_place) {
  KeyRegistry registry;
  SceneKey key;
  key.name = "gloam.collider";
  key.type = KeyType::text;
  key.set = [](KeyTarget&, const KeyValue&) -> Status { return Error{ErrorKind::usage, "needs a radius"}; };
  registry.add(std::move(key));
  GltfText gltf;
  gltf.add("nodes", R"({"name": "ball", "extras": {"gloam.collider": "sphere"}})");
  EXPECT_EQ(fault_of(gltf, registry), "scene.gltf: node 0 \"ball\": gloam.collider needs a radius");
}

TEST(KeyImport, extensions_come_before_keys_and_finishers_last_with_everything_in_place) {
  KeyRegistry registry;
  std::vector<std::string> calls;
  SceneExtension extension;
  extension.name = "TEST_extension";
  extension.begin = [&](World&, const SceneValue* root) -> Status {
    calls.push_back(root != nullptr && root->find("list") != nullptr ? "begin with root" : "begin");
    return {};
  };
  extension.on_node = [&](KeyTarget& target, const SceneValue& node) -> Status {
    calls.push_back("node " + std::to_string(node.find("value")->integral) + " " +
                    std::string(target.world.resource<SceneNames>().name_of(target.entity)));
    return {};
  };
  registry.add_extension(std::move(extension));
  SceneKey key;
  key.name = "gloam.test";
  key.type = KeyType::integer;
  key.set = [&](KeyTarget& target, const KeyValue& value) -> Status {
    calls.push_back("key " + std::to_string(std::get<long long>(value)) + " in " +
                    (target.directory.empty() ? "" : "a folder"));
    return {};
  };
  registry.add(std::move(key));
  registry.add_finish("test", [&](World& world) -> Status {
    calls.push_back("finish " + std::to_string(world.entity_count()));
    return {};
  });
  GltfText gltf;
  gltf.set("extensionsRequired", R"(["TEST_extension"])");
  gltf.set("extensions", R"({"TEST_extension": {"list": []}})");
  gltf.add("nodes", R"({"name": "a", "extras": {"gloam.test": 9007199254740991},
                        "extensions": {"TEST_extension": {"value": 3}}})");
  gltf.add("nodes", "{}");
  EXPECT_EQ(fault_of(gltf, registry), "");
  EXPECT_THAT(calls, ElementsAre("begin with root", "node 1 a", "key 9007199254740991 in a folder", "finish 2"));
}

TEST(KeyImport, a_finishers_fault_is_the_files) {
  KeyRegistry registry;
  registry.add_finish("test", [](World& world) -> Status {
    const Result<Entity> found = world.resource<SceneNames>().find("light", "moon");
    return found ? Status() : Status(found.error());
  });
  GltfText gltf;
  gltf.add("nodes", "{}");
  EXPECT_EQ(fault_of(gltf, registry), "scene.gltf: no light is named \"moon\"; there are none");
}

// Hard case: scene.required_extension, scene.unknown_extension
TEST(Extensions, unknown_ones_are_told_once_and_required_ones_refused) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  gltf.set("extensionsUsed", R"(["KHR_unheard_of", "KHR_unheard_of", "KHR_texture_transform", "KHR_lights_punctual"])");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(import.info().warnings,
              ElementsAre("scene.gltf: the extension \"KHR_unheard_of\" is not known, it is ignored"));
  gltf.set("extensionsRequired", R"(["KHR_texture_transform", "KHR_texture_basisu"])");
  EXPECT_EQ(fault_of(gltf), "scene.gltf: the extension \"KHR_texture_basisu\" is required, but not supported");
}

// Hard case: scene.undrawn_extension
TEST(Extensions, those_of_materials_that_are_not_drawn_are_named_in_one_line) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  gltf.set("extensionsUsed", R"(["KHR_materials_sheen", "KHR_materials_clearcoat", "KHR_materials_ior",
                                 "KHR_materials_specular", "KHR_materials_volume", "KHR_materials_transmission"])");
  gltf.add("materials", R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 0.5, 0]},
                            "KHR_materials_transmission": {"transmissionFactor": 0.5}}})");
  gltf.add("materials", R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1},
                            "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}}})");
  gltf.add("materials", R"({"extensions": {"KHR_materials_ior": {"ior": 1.33}}})");
  gltf.add("materials", R"({"extensions": {"KHR_materials_specular": {"specularColorFactor": [1, 1, 0.5]}}})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(import.info().warnings,
              ElementsAre("scene.gltf: drawn without KHR_materials_clearcoat, KHR_materials_ior, KHR_materials_sheen, "
                          "KHR_materials_specular"));
  gltf.set("extensionsRequired", R"(["KHR_materials_clearcoat"])");
  EXPECT_EQ(fault_of(gltf), "scene.gltf: the extension \"KHR_materials_clearcoat\" is required, but not supported");
}

TEST(Extensions, those_of_materials_that_change_nothing_are_not_told) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  gltf.set("extensionsUsed", R"(["KHR_materials_sheen", "KHR_materials_clearcoat", "KHR_materials_ior",
                                 "KHR_materials_specular", "KHR_materials_volume"])");
  gltf.add("materials", R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 0, 0]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0, "clearcoatRoughnessFactor": 0.5}, "KHR_materials_ior":
      {"ior": 1.5}, "KHR_materials_specular": {"specularFactor": 1, "specularColorFactor": [1, 1, 1]},
      "KHR_materials_volume": {"attenuationDistance": 3}}})");
  gltf.add("materials", R"({"extensions": {"KHR_materials_ior": {}, "KHR_materials_clearcoat": {}}})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  EXPECT_THAT(import.info().warnings, ::testing::IsEmpty());
}

}  // namespace
}  // namespace gloam
