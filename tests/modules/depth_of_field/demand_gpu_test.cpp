// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "modules/depth_of_field/components.h"
#include "tests/support/module_demand.h"

namespace gloam::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct DofDemand : ModuleDemand {
  DofDemand() : ModuleDemand("depth_of_field") {
    request.settings = look_at(dvec3(0.0, 0.5, 5.0), dvec3(0.0), 64, 48);
    request.settings.follow_camera = false;
    request.settings.camera_entity = camera;
    scene->draw(scene->mesh(quad(1.0f)));
  }
  /// Gives the view's camera these values.
  void focus(const DepthOfField& values) {
    if (world.try_get<DepthOfField>(camera) != nullptr) world.remove<DepthOfField>(camera);
    world.add<DepthOfField>(camera, values);
  }

  Entity camera = world.create(WorldTransform{});
};

TEST_F(DofDemand, a_camera_without_the_component_has_no_depth_of_field_at_all) {
  frames();
  expect_nothing();
}

TEST_F(DofDemand, a_camera_that_nothing_is_blurred_for_demands_nothing) {
  for (const DepthOfField& values :
       {DepthOfField{}, DepthOfField{.focus_m = -1.0f}, DepthOfField{.focus_m = std::nanf("")},
        DepthOfField{.focus_m = 2.0f, .f_number = kInfinity}, DepthOfField{.focus_m = 2.0f, .f_number = std::nanf("")},
        DepthOfField{.focus_m = 2.0f, .f_number = -1.0f}}) {
    focus(values);
    frames();
    expect_nothing();
  }
}

TEST_F(DofDemand, a_lens_that_is_too_small_to_blur_has_no_passes) {
  focus({.focus_m = 2.0f, .f_number = 1e6f});
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.pipelines, 0u);
  EXPECT_EQ(state.gpu_bytes, 0u);
}

TEST_F(DofDemand, a_camera_with_a_focus_has_passes_pipelines_and_memory_and_no_systems) {
  focus({.focus_m = 2.0f});
  frames();
  EXPECT_THAT(passes, testing::ElementsAre("dof_compose", "dof_gather", "dof_prefilter", "dof_sprites_find",
                                           "dof_sprites_reach", "dof_tile_bounds", "dof_tile_lists", "dof_tile_reach"));
  EXPECT_THAT(systems, testing::IsEmpty());
  EXPECT_GT(state.pipelines, 0u);
  EXPECT_TRUE(state.demanded);
}

TEST_F(DofDemand, captures_other_cameras_and_views_without_the_module_have_no_passes) {
  focus({.focus_m = 2.0f});
  request.settings.purpose = ViewPurpose::capture;
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.purpose = ViewPurpose::main;
  request.settings.without = {"depth_of_field"};
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.without.clear();
  request.settings.camera_entity = kNoEntity;
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.camera_entity = camera;
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(DofDemand, a_view_from_a_point_of_the_lens_is_not_blurred) {
  focus({.focus_m = 2.0f});
  world.set_resource(LensPoint{camera, glm::dvec2(0.01, 0.0), 2.0});
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
}

TEST_F(DofDemand, memory_is_freed_when_the_camera_loses_its_focus) {
  focus({.focus_m = 2.0f});
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
  world.remove<DepthOfField>(camera);
  frames(130);
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
}

}  // namespace
}  // namespace gloam::test
