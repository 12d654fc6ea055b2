// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <string>

#include "tests/modules/grass/support/grass_stage.h"
#include "tests/support/module_demand.h"

namespace gloam::test {
namespace {

/// A level square that may grow grass.
class GrassDemand : public ModuleDemand {
 protected:
  GrassDemand() : ModuleDemand("grass") {
    square = scene->draw(scene->mesh(quad(1.0f)), GrassStage::lying(dvec3(0.0)));
    request.settings = look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0), 64, 48);
  }
  void sow(float density) {
    GrassSurface values;
    values.density = density;
    world.add(square, values);
  }

  Entity square;
};

TEST_F(GrassDemand, a_scene_without_a_surface_has_no_grass_at_all) {
  frames();
  expect_nothing();
}

TEST_F(GrassDemand, wind_and_colliders_alone_demand_nothing) {
  world.create(Wind{vec3(3.0f, 0.0f, 0.0f), 0.3f}, WorldTransform{});
  world.create(Collider{ColliderShape::sphere, 0.5f, 1.8f, vec3(1.0f)}, WorldTransform{});
  frames();
  expect_nothing();
}

TEST_F(GrassDemand, a_density_of_0_and_no_density_at_all_demand_nothing) {
  for (const float density : {0.0f, -1.0f, std::nanf("")}) {
    sow(density);
    frames();
    expect_nothing();
    world.remove<GrassSurface>(square);
  }
}

TEST_F(GrassDemand, a_surface_in_view_has_passes_pipelines_and_memory) {
  sow(100.0f);
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
  EXPECT_THAT(systems, testing::Not(testing::IsEmpty()));
  EXPECT_GT(state.pipelines, 0u);
  EXPECT_GT(state.gpu_bytes, 0u);
  EXPECT_TRUE(state.demanded);
}

TEST_F(GrassDemand, a_surface_out_of_view_has_no_passes) {
  sow(100.0f);
  request.settings = look_at(dvec3(0.0, 0.5, 20.0), dvec3(0.0, 0.5, 40.0), 64, 48);
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
  request.settings = look_at(dvec3(0.0, 0.5, 100.0), dvec3(0.0), 64, 48);
  frames();
  EXPECT_THAT(passes, testing::IsEmpty()) << "beyond the range of the surface";
}

TEST_F(GrassDemand, static_views_and_views_without_the_module_have_no_passes) {
  sow(100.0f);
  request.settings.static_only = true;
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.static_only = false;
  request.settings.without = {"grass"};
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.without.clear();
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(GrassDemand, a_density_scale_of_0_draws_nothing) {
  sow(100.0f);
  ASSERT_TRUE(renderer->knobs().set("grass.density_scale", "0").ok());
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
}

TEST_F(GrassDemand, a_surface_that_disappears_gives_its_memory_back_and_may_return) {
  sow(100.0f);
  frames();
  EXPECT_GT(state.gpu_bytes, 0u);
  world.remove<GrassSurface>(square);
  frames(130);
  expect_nothing();
  sow(100.0f);
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(GrassDemand, memory_is_given_back_while_no_view_sees_grass) {
  sow(100.0f);
  frames();
  EXPECT_GT(state.gpu_bytes, 0u);
  request.settings = look_at(dvec3(0.0, 0.5, 20.0), dvec3(0.0, 0.5, 40.0), 64, 48);
  frames(130);
  EXPECT_EQ(state.gpu_bytes, 0u);
}

TEST_F(GrassDemand, blades_disappear_with_their_surface) {
  sow(100.0f);
  frames();
  EXPECT_EQ(world.view<const GrassBlade>().size(), 400u);
  world.remove<GrassSurface>(square);
  frames();
  EXPECT_EQ(world.view<const GrassBlade>().size(), 0u);
  EXPECT_EQ(world.view<const GrassPatch>().size(), 0u);
}

TEST_F(GrassDemand, a_knob_of_the_casters_decides_about_shadows) {
  sow(100.0f);
  frames();
  const std::set<std::string> with = passes;
  ASSERT_TRUE(renderer->knobs().set("grass.cast_distance", "0").ok());
  frames();
  EXPECT_EQ(passes, with) << "without lights nothing casts";
}

/// Frames that are given up.
using GrassGivenUp = GrassTest;

TEST_F(GrassGivenUp, leave_knots_and_picture_as_they_were) {
  const auto begin = [](GrassStage& stage) {
    stage.lawn(0.6f, 500);
    stage.wind(vec3(5.0f, 0.0f, 2.0f), 0.7f);
    stage.run_at(1.0 / 60.0);
  };
  for (const int failing : {0, 2})  // the first frame, and one that finds knots
    for (const FailAt at : some_of<FailAt>({FailAt::world_system, FailAt::view_system, FailAt::late_declaration,
                                            FailAt::recording, FailAt::recording_error})) {
      SCOPED_TRACE(static_cast<int>(at));
      GrassStage undisturbed, disturbed;
      begin(undisturbed);
      begin(disturbed);
      const ViewSettings view = front();
      for (int frame = 0; frame < 4; ++frame) {
        if (frame == failing) {
          disturbed.world.set_resource(Failure{at});
          EXPECT_FALSE(disturbed.try_draw(std::span(&view, 1)).ok());
          disturbed.world.set_resource(Failure{});
        }
        undisturbed.draw(view);
        disturbed.draw(view);
        EXPECT_TRUE(disturbed.copy().live_knots(disturbed.field()) ==
                    undisturbed.copy().live_knots(undisturbed.field()))
            << "frame " << frame;
      }
      EXPECT_EQ(differences(disturbed.linear().rgba, undisturbed.linear().rgba), 0u);
    }
}

TEST_F(GrassGivenUp, at_rest_upload_their_blades_again) {
  GrassStage undisturbed, disturbed;
  undisturbed.lawn(0.6f, 500);
  disturbed.lawn(0.6f, 500);
  const ViewSettings view = front();
  for (const FailAt at : {FailAt::late_declaration, FailAt::recording}) {
    disturbed.world.set_resource(Failure{at});
    EXPECT_FALSE(disturbed.try_draw(std::span(&view, 1)).ok());
    disturbed.world.set_resource(Failure{});
  }
  undisturbed.draw(view);
  disturbed.draw(view);
  EXPECT_EQ(differences(disturbed.linear().rgba, undisturbed.linear().rgba), 0u);
  EXPECT_EQ(disturbed.copy().draws.live, undisturbed.copy().draws.live);
}

}  // namespace
}  // namespace gloam::test
