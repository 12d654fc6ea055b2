// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/light_patch.h"

#include <gtest/gtest.h>

#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

class LightPatchTest : public ::testing::Test {
 protected:
  LightPatchTest() {
    prepare_world(world_, modules_);
    SceneBuilder builder(world_, info_);
    lamp_ = builder.add_light("lamp", Light{.intensity = 10.0f, .cookie = 3}, {1.0, 2.0, 3.0}, {0.0, -1.0, 0.0}, true);
    for (int i = 0; i < 2; ++i) builder.add_light("twin", Light{}, {}, {0.0, -1.0, 0.0}, true);
  }
  ModuleList modules_ = make_all_modules();
  World world_;
  SceneInfo info_;
  Entity lamp_;
};

TEST_F(LightPatchTest, changes_what_it_names_and_leaves_the_rest) {
  const auto patch = parse_light_patch(
      R"({"version": 1, "lights": {"lamp": {"intensity": 40, "color": [1, 0.5, 0.25], "shadows": false, "cookie": false,
          "translation": [0, 5, 0]}}})",
      "file");
  ASSERT_TRUE(patch.ok()) << patch.error().message;
  ASSERT_TRUE(apply_light_patch(world_, *patch).ok());
  const Light& light = world_.get<Light>(lamp_);
  EXPECT_EQ(light.intensity, 40.0f);
  EXPECT_EQ(light.color, vec3(1.0f, 0.5f, 0.25f));
  EXPECT_EQ(light.cookie, 0u);
  EXPECT_EQ(light.width_m, Light{}.width_m);
  EXPECT_FALSE(world_.get<ShadowCaster>(lamp_).enabled);
  EXPECT_EQ(world_.get<LocalTransform>(lamp_).translation, dvec3(0.0, 5.0, 0.0));
}

TEST_F(LightPatchTest, a_light_that_is_off_does_not_shine) {
  LightPatch patch;
  patch.lights["lamp"] = {.intensity = 40.0f, .on = false};
  ASSERT_TRUE(apply_light_patch(world_, patch).ok());
  EXPECT_EQ(world_.get<Light>(lamp_).intensity, 0.0f);
}

TEST_F(LightPatchTest, a_written_patch_is_read_unchanged) {
  LightPatch patch;
  patch.lights["lamp \"1\""] = {.intensity = 0.1f,
                                .color = vec3(0.3f, 1.0f, 7.0f),
                                .range_m = 8.0f,
                                .width_m = 0.01f,
                                .on = true,
                                .shadows = true,
                                .cookie = false,
                                .translation = dvec3(-1.0, 1e-9, 12345.678),
                                .rotation = glm::normalize(dquat(0.5, 0.1, -0.2, 0.3))};
  patch.lights["other"] = {};
  const auto read = parse_light_patch(light_patch_text(patch), "file");
  ASSERT_TRUE(read.ok()) << read.error().message;
  const LightChange &a = patch.lights.begin()->second, &b = read->lights.begin()->second;
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.translation, b.translation);
  EXPECT_LT(glm::length(*a.rotation - *b.rotation), 1e-15);
  EXPECT_EQ(read->lights.size(), 2u);
}

// Hard case: program.light_patch_faults
TEST_F(LightPatchTest, faults_are_usage_errors_that_name_the_place) {
  for (const auto& [text, fault] : std::initializer_list<std::pair<const char*, const char*>>{
           {"", "is not a JSON object"},
           {"[]", "is not a JSON object"},
           {"{}", "'version' is not 1"},
           {R"({"version": 2, "lights": {}})", "'version' is not 1"},
           {R"({"version": 1})", "'lights' is not an object"},
           {R"({"version": 1, "lights": [], "x": 1})", "'x' is unknown"},
           {R"({"version": 1, "lights": {"lamp": 3}})", "light 'lamp' is not an object"},
           {R"({"version": 1, "lights": {"lamp": {"Intensity": 3}}})", "'Intensity' is unknown"},
           {R"({"version": 1, "lights": {"lamp": {"intensity": -1}}})", "'intensity' is not a number from 0 on"},
           {R"({"version": 1, "lights": {"lamp": {"intensity": 1e300}}})", "'intensity' is not a number from 0 on"},
           {R"({"version": 1, "lights": {"lamp": {"color": [1, 2]}}})", "'color' does not have 3 numbers from 0 on"},
           {R"({"version": 1, "lights": {"lamp": {"color": [1, 2, "3"]}}})", "'color' does not have 3 numbers"},
           {R"({"version": 1, "lights": {"lamp": {"shadows": 1}}})", "'shadows' is not true or false"},
           {R"({"version": 1, "lights": {"lamp": {"rotation": [0, 0, 0, 0]}}})",
            "'rotation' is not a unit quaternion"}}) {
    const auto patch = parse_light_patch(text, "file.json");
    ASSERT_FALSE(patch.ok()) << text;
    EXPECT_EQ(patch.error().kind, ErrorKind::usage);
    EXPECT_TRUE(patch.error().message.starts_with("file.json: ")) << patch.error().message;
    EXPECT_NE(patch.error().message.find(fault), std::string::npos) << patch.error().message;
  }
}

TEST_F(LightPatchTest, text_that_is_nested_too_deep_is_a_usage_error) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  const auto patch =
      parse_light_patch(R"({"version": 1, "lights": {"lamp": {"intensity": )" + deep + "}}}", "file.json");
  ASSERT_FALSE(patch.ok());
  EXPECT_EQ(patch.error().message, "file.json: is nested deeper than 96 levels");
}

TEST_F(LightPatchTest, unknown_and_ambiguous_lights_change_nothing) {
  LightPatch patch;
  patch.lights["lamp"] = {.intensity = 40.0f};
  patch.lights["none"] = {};
  const Status unknown = apply_light_patch(world_, patch);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().kind, ErrorKind::usage);
  patch.lights.erase("none");
  patch.lights["twin"] = {};
  const Status twice = apply_light_patch(world_, patch);
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.error().kind, ErrorKind::input);
  EXPECT_EQ(world_.get<Light>(lamp_).intensity, 10.0f);
}

}  // namespace
}  // namespace gloam
