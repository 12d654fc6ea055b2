// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/gpu/recording_device.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "modules/module_list/module_list.h"
#include "tests/modules/grass/support/grass_stage.h"

namespace gloam::test {
namespace {

/// A renderer of all modules on a device that records commands, and a level square that may grow grass.
struct GrassDemand : testing::Test {
  void SetUp() override {
    device = gpu::make_recording_device();
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.log = &gpu_log();
    options.zones = &zones;
    options.modules = make_all_modules();
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    scene = std::make_unique<SceneMaker>(world);
    square = scene->draw(scene->mesh(quad(1.0f)), GrassStage::lying(dvec3(0.0)));
    request.settings = look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0), 64, 48);
  }
  void TearDown() override {
    scene.reset();
    renderer.reset();
    EXPECT_THAT(device->faults(), testing::IsEmpty());
    EXPECT_THAT(device->memory(), testing::Each(testing::Field(&gpu::ModuleMemory::bytes, 0u)));
  }
  void sow(float density) {
    GrassSurface values;
    values.density = density;
    world.add(square, values);
  }
  void frames(int count = 3) {
    for (int i = 0; i < count; ++i) {
      static_cast<void>(zones.take());
      const Status drawn = renderer->render(world, std::span(&request, 1));
      ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    }
    passes.clear();
    for (const PassTime& pass : renderer->report().passes)
      if (pass.module == "grass") passes.insert(pass.name);
    systems.clear();
    for (const Zone& zone : zones.take())
      if (zone.module == "grass") systems.insert(zone.name);
    for (const ModuleState& found : renderer->report().modules)
      if (found.name == "grass") state = found;
  }
  void expect_nothing() {
    EXPECT_THAT(passes, testing::IsEmpty());
    EXPECT_THAT(systems, testing::IsEmpty());
    EXPECT_EQ(state.pipelines, 0u);
    EXPECT_EQ(state.gpu_bytes, 0u);
    EXPECT_FALSE(state.demanded) << state.reason;
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  ZoneRecorder zones;
  std::unique_ptr<gpu::RecordingDevice> device;
  std::unique_ptr<Renderer> renderer;
  World world;
  std::unique_ptr<SceneMaker> scene;
  Entity square;
  ViewRequest request;
  std::set<std::string> passes, systems;
  ModuleState state;
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
