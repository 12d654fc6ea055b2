// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <span>
#include <string>

#include "engine/math/frustum.h"
#include "modules/grass/lod/visible_patches.h"
#include "modules/shadows/components.h"
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

TEST_F(GrassDemand, a_density_scale_of_0_is_no_demand_and_comes_back) {
  sow(100.0f);
  frames();
  ASSERT_TRUE(renderer->knobs().set("grass.density_scale", "0").ok());
  frames(130);
  expect_nothing();
  EXPECT_THAT(state.reason, testing::HasSubstr("grass.density_scale=0"));
  EXPECT_EQ(world.view<const GrassBlade>().size(), 0u);
  ASSERT_TRUE(renderer->knobs().set("grass.density_scale", "1").ok());
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

/// Grass close behind the camera, which looks at a wall; and lights that may throw its shadow there.
class GrassBehind : public GrassDemand {
 protected:
  GrassBehind() {
    sow(100.0f);
    wall = scene->draw(scene->mesh(quad(1.0f)), glm::translate(dmat4(1.0), dvec3(0.0, 0.5, 6.0)));
    request.settings = look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0, 0.5, 6.0), 64, 48);
  }
  Entity shine(LightKind kind, const dvec3& at, const dvec3& direction, bool casts = true, float range_m = 20.0f) {
    Light light;
    light.kind = kind;
    light.intensity = 10.0f;
    light.range_m = range_m;
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0.3, 1.0, 0.2), z));
    dmat4 matrix(1.0);
    matrix[0] = dvec4(x, 0.0);
    matrix[1] = dvec4(glm::cross(z, x), 0.0);
    matrix[2] = dvec4(z, 0.0);
    matrix[3] = dvec4(at, 1.0);
    return world.create(light, ShadowCaster{.enabled = casts}, WorldTransform{matrix});
  }
  void expect_grass(bool drawn, const char* why) {
    frames();
    EXPECT_EQ(passes.empty(), !drawn) << why;
    if (!drawn) {
      EXPECT_EQ(state.gpu_bytes, 0u) << why;
    }
  }
  Entity wall;
};

TEST_F(GrassBehind, is_not_drawn_without_a_light_that_casts) {
  expect_grass(false, "no light");
  shine(LightKind::point, dvec3(0.0, 1.0, -1.0), dvec3(0.0, 0.0, 1.0), false);
  shine(LightKind::directional, dvec3(0.0), dvec3(0.0, -0.2, 1.0), false);
  expect_grass(false, "lights without shadows");
  shine(LightKind::point, dvec3(0.0, 1.0, -1.5), dvec3(0.0, 0.0, 1.0));
  expect_grass(true, "a lamp behind it throws its shadow at the wall");
  ASSERT_TRUE(renderer->knobs().set("shadows.mode", "off").ok());
  frames(130);
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
}

TEST_F(GrassBehind, is_drawn_for_the_lights_whose_shadows_lead_into_the_view) {
  struct Case {
    LightKind kind;
    dvec3 at, direction;
    float range_m;
    bool drawn;
    const char* why;
  };
  const Case cases[] = {
      {LightKind::directional, dvec3(0.0), dvec3(0.0, -0.2, 1.0), 0.0f, true, "a low sun behind"},
      {LightKind::directional, dvec3(0.0), dvec3(0.0, -0.2, -1.0), 0.0f, false, "a low sun before the camera"},
      {LightKind::directional, dvec3(0.0), dvec3(0.0, -1.0, 0.0), 0.0f, false, "a high sun"},
      {LightKind::point, dvec3(0.0, 0.3, -2.0), dvec3(0.0, 0.0, 1.0), 20.0f, true, "a lamp behind the grass"},
      {LightKind::spot, dvec3(0.0, 0.3, -2.0), dvec3(0.0, 0.0, 1.0), 20.0f, true, "a spot behind the grass"},
      {LightKind::point, dvec3(0.0, 0.5, 5.0), dvec3(0.0, 0.0, 1.0), 20.0f, false, "a lamp at the wall"},
      {LightKind::point, dvec3(0.0, 0.5, 5.0), dvec3(0.0, 0.0, 1.0), 1.0f, false, "a lamp that does not reach it"},
      {LightKind::point, dvec3(0.0, 0.3, -2.0), dvec3(0.0, 0.0, 1.0), 3.0f, false,
       "a lamp that does not reach the view"}};
  for (const Case& c : cases) {
    const Entity light = shine(c.kind, c.at, c.direction, true, c.range_m);
    expect_grass(c.drawn, c.why);
    world.destroy(light);
    frames(130);
  }
}

TEST_F(GrassBehind, is_not_drawn_if_only_sky_is_in_view) {
  shine(LightKind::directional, dvec3(0.0), dvec3(0.0, -0.2, 1.0));
  expect_grass(true, "a wall is in view");
  world.destroy(wall);
  frames(130);
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
}

TEST_F(GrassBehind, no_shadow_that_rays_find_in_the_view_is_culled) {
  // Oracle: points of the box are moved away from the light in many steps; a point in the frustum is a shadow in view.
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const auto any = [&](float size) { return size * vec3(unit(random), unit(random), unit(random)); };
  const RenderView view = make_view(look_at(dvec3(100.0, 0.0, 0.0), dvec3(100.0, -0.2, 5.0), 64, 48), 0);
  int seen = 0, kept = 0;
  constexpr int kCases = 20000;
  for (int i = 0; i < kCases; ++i) {
    const vec3 center = any(8.0f), half = 0.6f * glm::abs(any(1.0f));
    const Aabb box{center - half, center + half};
    const CastingLight light{i % 2 == 0, view.position + dvec3(any(6.0f)), glm::normalize(any(1.0f)), 50.0f};
    const bool result = may_cast_into(view, box, light);
    kept += result ? 1 : 0;
    bool shadow = false;
    for (int ray = 0; ray < 30 && !shadow; ++ray) {
      const vec3 p = center + half * any(1.0f);
      const vec3 lamp = vec3(light.position - view.position);
      const vec3 way = light.directional ? light.direction : p - lamp;
      for (int step = 0; step < 40 && !shadow; ++step) {
        const vec3 at = p + way * (0.25f * static_cast<float>(step));
        shadow = light.directional || glm::length(at - lamp) < 50.0f;
        for (const Plane& plane : view.frustum.planes)
          shadow = shadow && glm::dot(plane.normal, at) + plane.distance >= 0.0f;
      }
    }
    seen += shadow ? 1 : 0;
    ASSERT_TRUE(result || !shadow) << i;
  }
  EXPECT_GT(seen, kCases / 50);
  EXPECT_LT(kept, kCases * 3 / 5) << "the test leaves most others out";
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
