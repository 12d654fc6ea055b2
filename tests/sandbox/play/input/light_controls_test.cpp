// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_controls.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/module_list/module_list.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

void mute(LightControls& controls, std::size_t light, bool muted) {
  LightValues values = controls.lights()[light].values;
  values.muted = muted;
  controls.set(light, values);
}

void solo(LightControls& controls, std::size_t light, bool alone) {
  LightValues values = controls.lights()[light].values;
  values.solo = alone;
  controls.set(light, values);
}

class LightControlsTest : public ::testing::Test {
 protected:
  LightControlsTest() {
    prepare_world(world_, modules_);
    SceneBuilder builder(world_, info_);
    for (const char* name : {"c", "a", "b"})
      lights_.push_back(builder.add_light(name, Light{.intensity = 10.0f}, {}, {0.0, -1.0, 0.0}, false));
  }
  [[nodiscard]] float intensity(const char* name) {
    return world_.get<Light>(*world_.resource<SceneNames>().find("light", name)).intensity;
  }
  ModuleList modules_ = make_all_modules();
  World world_;
  SceneInfo info_;
  std::vector<Entity> lights_;
};

TEST_F(LightControlsTest, lists_lights_by_name) {
  const LightControls controls(world_);
  ASSERT_EQ(controls.lights().size(), 3u);
  EXPECT_EQ(controls.lights()[0].name, "a");
  EXPECT_EQ(controls.lights()[2].name, "c");
}

TEST_F(LightControlsTest, lists_numbers_in_names_in_their_order) {
  SceneBuilder builder(world_, info_);
  for (const char* name : {"lamp 10", "lamp 2", "lamp 02 b", "lamp"})
    builder.add_light(name, Light{}, {}, {0.0, -1.0, 0.0}, false);
  std::vector<std::string> names;
  const LightControls controls(world_);
  for (const ControlledLight& light : controls.lights()) names.push_back(light.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "lamp", "lamp 2", "lamp 02 b", "lamp 10"}));
}

TEST_F(LightControlsTest, mute_turns_a_light_off_and_on_again) {
  LightControls controls(world_);
  mute(controls, 1, true);
  EXPECT_EQ(intensity("b"), 0.0f);
  EXPECT_EQ(intensity("a"), 10.0f);
  LightValues brighter = controls.lights()[1].values;
  brighter.intensity = 25.0f;
  controls.set(1, brighter);
  EXPECT_EQ(intensity("b"), 0.0f) << "a muted light stays dark";
  mute(controls, 1, false);
  EXPECT_EQ(intensity("b"), 25.0f);
}

TEST_F(LightControlsTest, solo_leaves_only_the_solo_lights_that_are_not_muted) {
  LightControls controls(world_);
  solo(controls, 0, true);
  solo(controls, 1, true);
  mute(controls, 1, true);
  EXPECT_EQ(intensity("a"), 10.0f);
  EXPECT_EQ(intensity("b"), 0.0f);
  EXPECT_EQ(intensity("c"), 0.0f);
  solo(controls, 0, false);
  solo(controls, 1, false);
  EXPECT_EQ(intensity("c"), 10.0f);
}

TEST_F(LightControlsTest, only_changes_are_marked) {
  LightControls controls(world_);
  const View<const Light> view = world_.view<const Light>();
  int blocks = 0;
  const auto count = [&](std::span<const Entity>, std::span<const Light>) { ++blocks; };
  const Tick since = view.changed_since<const Light>(0, count);
  blocks = 0;
  mute(controls, 0, false);
  const Tick later = view.changed_since<const Light>(since, count);
  EXPECT_EQ(blocks, 0);
  mute(controls, 0, true);
  static_cast<void>(view.changed_since<const Light>(later, count));
  EXPECT_EQ(blocks, 1);
}

TEST_F(LightControlsTest, a_light_that_is_gone_is_left_out) {
  LightControls controls(world_);
  world_.destroy(lights_[0]);
  solo(controls, 0, true);
  EXPECT_EQ(intensity("b"), 0.0f);
}

}  // namespace
}  // namespace gloam
