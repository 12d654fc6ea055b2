// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/keys.h"

#include <gmock/gmock.h>

#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// One imported file with lights.
struct LitFile {
  Import import;

  LitFile(const std::vector<std::string>& lights, const std::vector<std::string>& nodes) {
    std::string list;
    for (const std::string& light : lights) list += (list.empty() ? "" : ", ") + light;
    read(R"({"KHR_lights_punctual": {"lights": [)" + list + "]}}", nodes);
  }
  /// The root's extensions as text; null: none.
  LitFile(const char* extensions, const std::vector<std::string>& nodes, int) {
    read(extensions != nullptr ? extensions : "", nodes);
  }

  [[nodiscard]] const Light* light(std::size_t node) const { return import.world.try_get<Light>(import.node(node)); }

 private:
  void read(const std::string& extensions, const std::vector<std::string>& nodes) {
    GltfText file;
    file.set("extensionsUsed", R"(["KHR_lights_punctual"])");
    if (!extensions.empty()) file.set("extensions", extensions);
    std::string indices;
    for (const std::string& node : nodes)
      indices += (indices.empty() ? "" : ", ") + std::to_string(file.add("nodes", node));
    file.add("scenes", R"({"nodes": [)" + indices + "]}");
    KeyRegistry registry;
    add_engine_keys(registry);
    add_light_keys(registry);
    import.world.register_component<Light>("light");
    test::import_text(file.text(), import, {}, registry);
  }
};

std::string node_with(int light, const std::string& more = {}) {
  return R"({"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": )" + std::to_string(light) + "}}" + more +
         "}";
}
/// The error for a file with one light on one node.
std::string fault_of(const std::string& light) {
  const LitFile file({light}, {node_with(0)});
  EXPECT_FALSE(file.import.ok()) << light;
  if (!file.import.ok()) {
    EXPECT_EQ(file.import.result.error().kind, ErrorKind::input);
  }
  const std::string fault = file.import.fault();
  EXPECT_THAT(fault, AllOf(StartsWith("scene.gltf: KHR_lights_punctual: light 0: "), Not(HasSubstr("\n")))) << light;
  EXPECT_EQ(fault.find("KHR_lights_punctual"), fault.rfind("KHR_lights_punctual")) << "said twice: " << fault;
  return fault;
}

using Kind = SceneValue::Kind;

/// Calls the extension directly: its error for a file's root with this light, or the light a node gets. Reaches errors
/// that the JSON reader would report first.
struct DirectRead {
  World world;
  Status status;
  Light light;

  explicit DirectRead(const SceneValue& definition) {
    KeyRegistry registry;
    add_light_keys(registry);
    prepare_scene_world(world);
    world.register_component<Light>("light");
    const SceneExtension& extension = registry.extensions().at(0);
    const SceneValue lights{.kind = Kind::array, .items = {definition}};
    const SceneValue root{.kind = Kind::object, .members = {{"lights", lights}}};
    status = extension.begin(world, &root);
    if (!status.ok()) return;
    KeyTarget target{world, world.create()};
    const SceneValue index{.kind = Kind::number, .integral = true};
    status = extension.on_node(target, SceneValue{.kind = Kind::object, .members = {{"light", index}}});
    if (status.ok()) light = world.get<Light>(target.entity);
  }
  [[nodiscard]] std::string fault() const { return status.ok() ? "" : status.error().message; }
};
SceneValue text(const char* value) { return {.kind = Kind::text, .text = value}; }
SceneValue object(std::vector<SceneMember> members) { return {.kind = Kind::object, .members = std::move(members)}; }

TEST(LightImport, fills_the_defaults_of_the_extension) {
  const LitFile file({R"({"type": "point"})", R"({"type": "spot", "spot": {}})", R"({"type": "directional"})"},
                     {node_with(0), node_with(1), node_with(2), R"({"name": "none"})"});
  ASSERT_TRUE(file.import.ok()) << file.import.fault();
  const LightKind kinds[] = {LightKind::point, LightKind::spot, LightKind::directional};
  for (std::size_t i = 0; i < 3; ++i) {
    const Light* light = file.light(i);
    ASSERT_NE(light, nullptr);
    EXPECT_EQ(light->kind, kinds[i]);
    EXPECT_EQ(light->color, vec3(1.0f));
    EXPECT_EQ(light->intensity, 1.0f);
    EXPECT_EQ(light->range_m, 0.0f);
    EXPECT_EQ(light->width_m, 0.0f);
  }
  EXPECT_EQ(file.light(1)->inner_angle, 0.0f);
  EXPECT_FLOAT_EQ(file.light(1)->outer_angle, kPi / 4.0f);
  EXPECT_EQ(file.light(3), nullptr);
}

TEST(LightImport, reads_everything_a_light_says) {
  const LitFile file({R"({"type": "spot", "color": [0.5, 0.25, 0], "intensity": 120.5, "range": 7.5,
                          "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}})"},
                     {node_with(0), node_with(0)});
  ASSERT_TRUE(file.import.ok()) << file.import.fault();
  for (std::size_t node = 0; node < 2; ++node) {
    EXPECT_EQ(file.light(node)->color, vec3(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(file.light(node)->intensity, 120.5f);
    EXPECT_EQ(file.light(node)->range_m, 7.5f);
    EXPECT_EQ(file.light(node)->inner_angle, 0.2f);
    EXPECT_EQ(file.light(node)->outer_angle, 0.6f);
  }
}

TEST(LightImport, names_lights_after_their_nodes_and_leaves_nameless_ones_out) {
  const LitFile file({R"({"type": "point", "name": "definition"})"},
                     {node_with(0), R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"});
  ASSERT_TRUE(file.import.ok()) << file.import.fault();
  EXPECT_THAT(file.import.world.resource<SceneNames>().names("light"), ElementsAre("lamp"));
}

TEST(LightImport, takes_cones_of_up_to_180_degrees_as_files_round_them) {
  for (const char* angle : {"1.5707963267948966", "1.5707964", "1.5707963"}) {
    const LitFile file({std::string(R"({"type": "spot", "spot": {"outerConeAngle": )") + angle + "}}"}, {node_with(0)});
    ASSERT_TRUE(file.import.ok()) << file.import.fault();
    EXPECT_LE(file.light(0)->outer_angle, kPi * 0.5f);
    EXPECT_NEAR(file.light(0)->outer_angle, kPi * 0.5f, 1e-6f);
  }
}

// Hard case: scene.cone_over_180
TEST(LightImport, refuses_cones_over_180_degrees) {
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"outerConeAngle": 1.5709}})"),
              AllOf(HasSubstr("outerConeAngle"), HasSubstr("180°")));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"outerConeAngle": 3.2}})"), HasSubstr("outerConeAngle"));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"innerConeAngle": 1.6, "outerConeAngle": 1.5}})"),
              HasSubstr("innerConeAngle"));
}

TEST(LightImport, refuses_cones_that_are_none) {
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.4}})"),
              EndsWith("innerConeAngle must not exceed outerConeAngle"));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"innerConeAngle": 1.0}})"), HasSubstr("must not exceed"));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"outerConeAngle": 0}})"),
              EndsWith("outerConeAngle must be above 0"));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"innerConeAngle": -0.1}})"),
              HasSubstr("innerConeAngle must be a number"));
  EXPECT_THAT(fault_of(R"({"type": "spot", "spot": {"outerConeAngle": "wide"}})"),
              HasSubstr("outerConeAngle must be a number"));
  EXPECT_EQ(DirectRead(object({{"type", text("spot")}, {"spot", text("wide")}})).fault(),
            "light 0: spot must be an object");
}

TEST(LightImport, looks_at_cones_of_spots_only) {
  const LitFile file({R"({"type": "point", "spot": {"outerConeAngle": 9}})"}, {node_with(0)});
  EXPECT_TRUE(file.import.ok()) << file.import.fault();
}

TEST(LightImport, refuses_unknown_and_missing_types) {
  EXPECT_THAT(fault_of(R"({"type": "area"})"), EndsWith("type \"area\" is none of point, spot, directional"));
  EXPECT_EQ(DirectRead(object({})).fault(), "light 0: a light needs a type");
  EXPECT_EQ(DirectRead(object({{"type", object({})}})).fault(), "light 0: a light needs a type");
  EXPECT_EQ(DirectRead(text("point")).fault(), "light 0: a light needs a type");
  for (const char* light : {R"({"intensity": 3})", R"({"type": 1})", "7", "null"}) {
    const LitFile file({light}, {node_with(0)});
    ASSERT_FALSE(file.import.ok()) << light;
    EXPECT_EQ(file.import.result.error().kind, ErrorKind::input);
    EXPECT_THAT(file.import.fault(), AllOf(StartsWith("scene.gltf: "), Not(HasSubstr("\n"))));
  }
}

TEST(LightImport, takes_a_spot_without_a_cone_for_one_of_90_degrees) {
  const DirectRead read(object({{"type", text("spot")}}));
  ASSERT_TRUE(read.status.ok()) << read.fault();
  EXPECT_EQ(read.light.kind, LightKind::spot);
  EXPECT_EQ(read.light.inner_angle, 0.0f);
  EXPECT_FLOAT_EQ(read.light.outer_angle, kPi / 4.0f);
}

TEST(LightImport, refuses_ranges_that_are_not_above_0) {
  for (const char* range : {"0", "-1", "1e39", "\"far\"", "null", "[1]"})
    EXPECT_THAT(fault_of(std::string(R"({"type": "point", "range": )") + range + "}"),
                HasSubstr("range must be a number above 0"));
}

TEST(LightImport, refuses_bad_intensities_and_colours) {
  for (const char* intensity : {"-1", "1e13", "true"})
    EXPECT_THAT(fault_of(std::string(R"({"type": "point", "intensity": )") + intensity + "}"),
                HasSubstr("intensity must be a number"));
  for (const char* color : {"[1, 1]", "[1, 1, 1, 1]", "[1, -1, 1]", "[1, \"a\", 1]", "1", "[1, 2000000, 1]"})
    EXPECT_THAT(fault_of(std::string(R"({"type": "point", "color": )") + color + "}"),
                HasSubstr("color must be three numbers"));
}

TEST(LightImport, refuses_a_root_without_a_list_of_lights) {
  for (const char* root : {R"({"KHR_lights_punctual": {}})", R"({"KHR_lights_punctual": {"lights": 3}})"}) {
    const LitFile file(root, {node_with(0)}, 0);
    EXPECT_EQ(file.import.fault(), "scene.gltf: KHR_lights_punctual: lights must be an array");
  }
}

TEST(LightImport, refuses_nodes_whose_light_is_missing) {
  const std::string light = R"({"type": "point"})";
  for (const int index : {1, 1000000}) {
    const LitFile file({light}, {node_with(index)});
    EXPECT_EQ(file.import.fault(),
              "scene.gltf: node 0 \"lamp\": KHR_lights_punctual names a light that does not exist, the file has 1");
  }
  const LitFile no_root(nullptr, {node_with(0)}, 0);
  EXPECT_THAT(no_root.import.fault(), EndsWith("names a light that does not exist, the file has 0"));
  for (const char* index : {"-1", "0.5", "\"lamp\"", "null"}) {
    const LitFile file({light}, {std::string(R"({"extensions": {"KHR_lights_punctual": {"light": )") + index + "}}}"});
    EXPECT_EQ(file.import.fault(), "scene.gltf: node 0: KHR_lights_punctual must name its light by a whole number");
  }
  const LitFile file({light}, {R"({"extensions": {"KHR_lights_punctual": {}}})"});
  EXPECT_FALSE(file.import.ok());
  const LitFile huge({light}, {R"({"extensions": {"KHR_lights_punctual": {"light": 1e300}}})"});
  EXPECT_THAT(huge.import.fault(), HasSubstr("does not exist"));
}

TEST(LightImport, of_a_file_does_not_see_the_lights_of_the_file_before) {
  World world;
  KeyRegistry registry;
  add_light_keys(registry);
  const SceneExtension& extension = registry.extensions().at(0);
  SceneValue type{.kind = SceneValue::Kind::text, .text = "point"};
  SceneValue light{.kind = SceneValue::Kind::object, .members = {{"type", type}}};
  SceneValue lights{.kind = SceneValue::Kind::array, .items = {light}};
  SceneValue root{.kind = SceneValue::Kind::object, .members = {{"lights", lights}}};
  prepare_scene_world(world);
  world.register_component<Light>("light");
  ASSERT_TRUE(extension.begin(world, &root).ok());
  ASSERT_TRUE(extension.begin(world, nullptr).ok());
  KeyTarget target{world, world.create()};
  SceneValue index{.kind = SceneValue::Kind::number, .integral = true};
  EXPECT_FALSE(
      extension.on_node(target, SceneValue{.kind = SceneValue::Kind::object, .members = {{"light", index}}}).ok());
}

TEST(LightKeys, stand_on_lights_only) {
  const LitFile file({R"({"type": "point"})"}, {R"({"name": "box", "extras": {"gloam.light.width": 0.1}})"});
  EXPECT_EQ(file.import.fault(), "scene.gltf: node 0 \"box\": gloam.light.width belongs on a node with a light");
}

TEST(LightKeys, width_is_metres_and_angle_becomes_radians) {
  const LitFile file({R"({"type": "point"})", R"({"type": "directional"})"},
                     {node_with(0, R"(, "extras": {"gloam.light.width": 0.25})"),
                      node_with(1, R"(, "extras": {"gloam.light.angle": 2})")});
  ASSERT_TRUE(file.import.ok()) << file.import.fault();
  EXPECT_EQ(file.light(0)->width_m, 0.25f);
  EXPECT_FLOAT_EQ(file.light(1)->apparent_angle, 2.0f * kPi / 180.0f);
}

TEST(LightKeys, angle_is_refused_on_lights_that_have_a_place) {
  for (const char* type : {"point", "spot"}) {
    const LitFile file({std::string(R"({"spot": {}, "type": ")") + type + "\"}"},
                       {node_with(0, R"(, "extras": {"gloam.light.angle": 2})")});
    EXPECT_THAT(file.import.fault(), HasSubstr("gloam.light.angle is for directional lights"));
  }
}

/// The error for a cookie on a light of this type, in a folder that holds cookie.png.
std::string cookie_fault(const char* type, const char* name, std::string* stored = nullptr) {
  World world;
  prepare_scene_world(world);
  world.register_component<Light>("light");
  KeyRegistry registry;
  add_light_keys(registry);
  const test::TemporaryFolder folder;
  static_cast<void>(folder.write("inner/cookie.png", "not looked at yet"));
  static_cast<void>(folder.write("outside.png", "not looked at yet"));
  Light light;
  if (std::string_view(type) == "spot") light.kind = LightKind::spot;
  KeyTarget target{world, world.create(light), ~0u, folder.path() + "/inner"};
  const Status status = registry.find("gloam.light.cookie")->set(target, KeyValue(std::string(name)));
  if (stored != nullptr) *stored = world.resource<SceneStrings>().text(world.get<Light>(target.entity).cookie);
  return status.ok() ? "" : status.error().message;
}

TEST(LightKeys, cookie_is_a_file_in_the_scenes_folder_on_a_spot) {
  std::string stored;
  EXPECT_EQ(cookie_fault("spot", "cookie.png", &stored), "");
  EXPECT_THAT(stored, EndsWith("/inner/cookie.png"));
  EXPECT_THAT(cookie_fault("spot", "absent.png"), HasSubstr("absent"));
  EXPECT_THAT(cookie_fault("point", "cookie.png"), HasSubstr("only a spot"));
}

TEST(LightKeys, cookie_does_not_leave_the_scenes_folder) {
  for (const char* name :
       {"../outside.png", "..%2Foutside.png", "/etc/passwd", "x/../../outside.png", "file:///etc/passwd", ""})
    EXPECT_NE(cookie_fault("spot", name), "") << name;
}

}  // namespace
}  // namespace gloam
