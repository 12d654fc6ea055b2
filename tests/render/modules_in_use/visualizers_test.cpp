// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/visualizers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string_view>

#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

/// A module with one visualizer of each kind.
class ShowingModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "showing"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  void knobs(KnobRegistry& registry) const override {
    Knob knob;
    knob.name = "showing.mode";
    knob.module = "showing";
    knob.meaning = "a mode";
    knob.choices = {"off", "near", "far"};
    registry.add(knob);
  }
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "always"}; }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    VisualizerInfo bound{"bound", "showing", "", "needs a knob"};
    bound.knob = "showing.mode";
    bound.value = "near|far";
    return {{"plain", "showing", "", "no argument"}, {"of_light", "showing", "LIGHT", "a light"}, bound};
  }
};

class VisualizersTest : public ::testing::Test {
 protected:
  VisualizersTest() {
    modules_.push_back(std::make_unique<ShowingModule>());
    modules_[0]->knobs(knobs_);
    prepare_scene_world(world_);
  }
  /// The error's sentence; empty if the visualizer can be shown.
  [[nodiscard]] std::string fault(std::string_view name) const {
    const Status status = check_visualizer(modules_, knobs_, world_, name);
    EXPECT_TRUE(status.ok() || status.error().kind == ErrorKind::usage);
    return status.ok() ? "" : status.error().message;
  }

  ModuleList modules_;
  KnobRegistry knobs_;
  World world_;
};

TEST_F(VisualizersTest, those_of_the_engine_have_codes_in_the_order_of_the_list) {
  const std::vector<VisualizerInfo> all = all_visualizers(modules_);
  ASSERT_GE(all.size(), 4u);
  EXPECT_EQ(all[0].name, "none");
  EXPECT_EQ(engine_visualizer_code("none"), 0u);
  for (std::uint32_t i = 1; i < 4; ++i) EXPECT_EQ(engine_visualizer_code(all[i].name), i) << all[i].name;
  EXPECT_EQ(engine_visualizer_code("plain"), 0u);
}

TEST_F(VisualizersTest, faults_are_one_line_whatever_the_name_is) {
  for (const char* name : {"\n", "a\x01", "\n:\n", "normal:\n"}) {
    EXPECT_FALSE(fault(name).empty()) << name;
    EXPECT_EQ(fault(name).find_first_of("\n\x01"), std::string::npos) << fault(name);
  }
}

TEST_F(VisualizersTest, names_arguments_and_knobs_are_checked) {
  EXPECT_EQ(fault("none"), "");
  EXPECT_EQ(fault("normal"), "");
  EXPECT_EQ(fault("plain"), "");
  EXPECT_EQ(fault("plain:x"), "view plain takes no argument");
  EXPECT_EQ(fault("plain:"), "view plain takes no argument");
  EXPECT_EQ(fault("of_light"), "view of_light needs :LIGHT");
  EXPECT_THAT(fault("of_light:absent"), HasSubstr("absent"));
  EXPECT_THAT(fault("plane"), HasSubstr("unknown view plane"));
  EXPECT_THAT(fault("plane"), HasSubstr("of_light:LIGHT"));
}

TEST_F(VisualizersTest, a_knob_must_be_at_one_of_the_values) {
  EXPECT_EQ(fault("bound"), "view bound needs showing.mode=near|far");
  ASSERT_TRUE(knobs_.set("showing.mode", "far").ok());
  EXPECT_EQ(fault("bound"), "");
}

}  // namespace
}  // namespace gloam
