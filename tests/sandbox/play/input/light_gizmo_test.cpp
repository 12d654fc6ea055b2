// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_gizmo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
#include "sandbox/play/input/view_projection.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

/// A spot at (0, 2, 0) that shines down, seen from (0, 2, 6).
class LightGizmoTest : public ::testing::Test {
 protected:
  LightGizmoTest() {
    prepare_world(world_, modules_);
    SceneBuilder builder(world_, info_);
    builder.add_light("lamp", Light{.kind = LightKind::spot, .intensity = 10.0f}, {0.0, 2.0, 0.0}, {0.1, -1.0, 0.0},
                      true);
    controls_ = std::make_unique<LightControls>(world_);
    view_.width = 640;
    view_.height = 360;
    view_.world_from_camera = glm::translate(dmat4(1.0), dvec3(0.5, 2.5, 6.0));
    pose();
  }
  void pose() {
    Schedule schedule;
    add_scene_systems(schedule);
    schedule.run(Stage::world, world_, *executor_);
  }
  [[nodiscard]] glm::dvec2 place(const dvec3& position) const { return *place_in_picture(view_, position); }
  bool steer(const glm::dvec2& pointer, bool down, bool free = true) {
    const bool used = gizmo_.steer(*controls_, 0, view_, pointer, down, free);
    pose();
    return used;
  }

  ModuleList modules_ = make_all_modules();
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
  World world_;
  SceneInfo info_;
  std::unique_ptr<LightControls> controls_;
  ViewSettings view_;
  LightGizmo gizmo_;
};

TEST_F(LightGizmoTest, an_axis_moves_the_light_along_itself) {
  EXPECT_TRUE(steer(place({0.5, 2.0, 0.0}), true));
  EXPECT_TRUE(steer(place({1.5, 2.0, 0.0}), true));
  EXPECT_LT(glm::distance(controls_->position(0), dvec3(1.0, 2.0, 0.0)), 1e-6);
  EXPECT_TRUE(steer(place({1.5, 2.0, 0.0}), false)) << "letting go is no click on the picture";
  EXPECT_FALSE(steer(place({1.5, 2.0, 0.0}), false));
}

TEST_F(LightGizmoTest, the_square_aims_the_light_at_the_pointer) {
  const auto marks = gizmo_.marks(*controls_, 0, view_);
  const auto square = std::ranges::find(marks, PanelMark::Shape::square, &PanelMark::shape);
  ASSERT_NE(square, marks.end());
  EXPECT_TRUE(steer(square->from, true));
  const glm::dvec2 target = square->from + glm::dvec2(40.0, -15.0);
  EXPECT_TRUE(steer(target, true));
  EXPECT_TRUE(steer(target, true));
  const dvec3 direction = controls_->direction(0);
  EXPECT_NEAR(glm::length(direction), 1.0, 1e-6);
  // The line of light passes below the pointer.
  const SightLine sight = sight_line(view_, target);
  const dvec3 normal = glm::normalize(glm::cross(direction, sight.direction));
  EXPECT_LT(std::abs(glm::dot(normal, controls_->position(0) - sight.from)), 0.02);
}

TEST_F(LightGizmoTest, leaves_the_pointer_alone_elsewhere_and_when_it_is_taken) {
  EXPECT_FALSE(steer({10.0, 10.0}, true));
  EXPECT_FALSE(steer(place({0.5, 2.0, 0.0}), true)) << "a drag that began elsewhere turns the camera";
  EXPECT_FALSE(steer({}, false));
  EXPECT_FALSE(steer(place({0.5, 2.0, 0.0}), true, false)) << "a widget has the pointer";
  EXPECT_EQ(controls_->position(0), dvec3(0.0, 2.0, 0.0));
}

TEST_F(LightGizmoTest, changes_are_a_patch) {
  EXPECT_TRUE(controls_->patch().lights.empty());
  controls_->move(0, {0.0, 3.0, 0.0});
  const LightPatch patch = controls_->patch();
  ASSERT_TRUE(patch.lights.contains("lamp"));
  EXPECT_EQ(patch.lights.at("lamp").translation, dvec3(0.0, 3.0, 0.0));
  EXPECT_FALSE(patch.lights.at("lamp").rotation) << "only what has changed";
}

}  // namespace
}  // namespace gloam
