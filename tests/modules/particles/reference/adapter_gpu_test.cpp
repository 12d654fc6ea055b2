// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/reference/adapter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/posing/animation.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "tests/modules/particles/bake/bake_scene.h"
#include "tests/modules/particles/support/particle_stage.h"
#include "tests/support/memory_store.h"

namespace gloam::test {
namespace {

class TracedParticles : public ParticleTest {
 protected:
  /// Draws `view` and then its reference with the triangles of `tracer`. `drawn`: set to the frame's linear light.
  std::vector<float> trace(ParticleStage& stage, const ViewSettings& view, const SceneTracer& tracer,
                           std::vector<float>& drawn, std::uint32_t samples = 16) {
    stage.draw(view);
    drawn = stage.linear();
    const FramePictures frame;
    const auto executor = make_pool_executor(2);
    ReferenceInput input = {.world = stage.world,
                            .view = stage.world.view_resource<RenderView>(view.id),
                            .knobs = stage.renderer->knobs(),
                            .frame = frame,
                            .samples = samples,
                            .executor = *executor,
                            .tracer = &tracer,
                            .store = &store};
    input.redraw = [&](const std::function<void(World&)>& change,
                       const std::function<void(World&)>& restore) -> Result<FramePictures> {
      change(stage.world);
      for (int i = 0; i < 2; ++i) stage.draw(view);
      outdated = stage.world.resource<EmitterLights>().outdated;
      FramePictures pictures{.linear = value_of(stage.renderer->read_linear(view.id)), .picture = {}};
      restore(stage.world);
      return pictures;
    };
    return value_of(draw_traced_particles(input)).linear.rgba;
  }
  /// Σ |a − b| / Σ b over colours.
  static double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double error = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (i % 4 == 3) continue;
      error += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      sum += static_cast<double>(b[i]);
    }
    EXPECT_GT(sum, 1.0);
    return error / sum;
  }
  /// Light of each half of a picture, left and right.
  static std::pair<double, double> halves(const std::vector<float>& picture, std::uint32_t width) {
    double sums[2] = {};
    for (std::size_t i = 0; i < picture.size() / 4; ++i)
      sums[i % width < width / 2 ? 0 : 1] += static_cast<double>(picture[4 * i]);
    return {sums[0], sums[1]};
  }
  static void darken(ParticleStage& stage) {
    auto& sky = stage.world.resource<SceneEnvironment>();
    sky.sky_zenith = sky.sky_horizon = sky.sky_ground = vec3(0.0f);
  }

  MemoryStore store;
  std::uint32_t outdated = 0;  ///< maps that the last reference did not use
};

const WallTracer kNoWall(0.0);

TEST_F(TracedParticles, without_blockers_are_the_frame_lit_at_each_pixel) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  stage.lamp({-2.0, 0.5, 1.0}, vec3(1.0f, 0.5f, 0.2f), 40.0f, 9.0f);
  std::vector<float> vertex, pixel;
  const std::vector<float> traced = trace(stage, front(), kNoWall, vertex);
  stage.set("particles.lighting", "pixel");
  const std::vector<float> again = trace(stage, front(), kNoWall, pixel);
  EXPECT_EQ(outdated, 0u);
  EXPECT_EQ(traced, again) << "the knob's value does not enter";
  EXPECT_LT(difference(pixel, traced), 1e-3);
  EXPECT_GT(difference(vertex, traced), 1e-3);
}

TEST_F(TracedParticles, are_lit_by_many_lamps_at_once) {
  ParticleStage stage;
  stage.set("particles.lighting", "pixel");
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  for (int i = 0; i < 12; ++i) stage.lamp({-3.0, 0.5, 1.0}, vec3(1.0f), 10.0f, 9.0f);
  std::vector<float> drawn;
  const std::vector<float> many = trace(stage, front(), kNoWall, drawn);
  EXPECT_LT(halves(drawn, 64).first, 0.6 * halves(many, 64).first) << "a frame has the light of four";
  ParticleStage other;
  other.set("particles.lighting", "pixel");
  other.emitter(cloud(EmitterKind::smoke, 150.0f));
  other.lamp({-3.0, 0.5, 1.0}, vec3(1.0f), 120.0f, 9.0f);
  static_cast<void>(trace(other, front(), kNoWall, drawn));
  EXPECT_LT(difference(many, drawn), 0.02);
}

TEST_F(TracedParticles, are_dark_behind_a_wall) {
  ParticleStage stage;
  darken(stage);
  ParticleEmitter values = cloud(EmitterKind::smoke, 300.0f);
  values.box_m = vec3(3.0f, 1.0f, 1.0f);
  stage.emitter(values);
  const Entity lamp = stage.lamp({-3.0, 0.0, 0.0}, vec3(1.0f), 40.0f, 20.0f);
  const ViewSettings view = look_at(dvec3(0.0, 0.0, 6.0), dvec3(0.0), 64, 48);
  std::vector<float> drawn;
  const auto [left, right] = halves(trace(stage, view, WallTracer(50.0), drawn), 64);
  const auto [drawn_left, drawn_right] = halves(drawn, 64);
  EXPECT_NEAR(left, drawn_left, 0.1 * drawn_left);
  EXPECT_GT(drawn_right, 0.05 * drawn_left) << "frames without a map have no shadows but those of the cloud itself";
  EXPECT_LT(right, 0.2 * drawn_right) << "sprites of the left side reach over the middle";
  // The light of a lamp with its shadow is the same in the flux of a map as beside it.
  for (int i = 0; i < 4; ++i) stage.lamp({-3.0, 0.0, 0.0}, vec3(1.0f), 41.0f, 20.0f);
  const auto [five_left, five_right] = halves(trace(stage, view, WallTracer(50.0), drawn), 64);
  stage.world.destroy(lamp);
  const auto [four_left, four_right] = halves(trace(stage, view, WallTracer(50.0), drawn), 64);
  EXPECT_NEAR(five_left - four_left, left, 0.05 * left);
  EXPECT_NEAR(five_right - four_right, right, 0.05 * left);
}

TEST_F(TracedParticles, follow_moving_emitters_and_lamps) {
  ParticleStage stage;
  stage.set("particles.lighting", "pixel");
  const Entity emitter = stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  const Entity lamp = stage.lamp({-2.0, 0.5, 1.0}, vec3(1.0f), 40.0f, 9.0f);
  stage.world.resource<AnimationBindings>().poses = {{emitter, 0, 0}, {lamp, 0, 0}};
  std::vector<float> drawn;
  const auto [left, right] = halves(trace(stage, front(), WallTracer(50.0), drawn), 64);
  const auto [drawn_left, drawn_right] = halves(drawn, 64);
  EXPECT_EQ(outdated, 0u);
  EXPECT_LT(right, 0.8 * drawn_right);
  EXPECT_GT(left, 0.8 * drawn_left);
}

TEST_F(TracedParticles, leave_the_world_as_it_was) {
  ParticleStage stage;
  const Entity emitter = stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  const Entity lamp = stage.lamp({-2.0, 0.5, 1.0}, vec3(1.0f), 40.0f, 9.0f);
  auto& maps = stage.world.resource<ParticleLightMaps>();
  const auto executor = make_serial_executor();
  maps = bake_particle_light({.world = stage.world, .tracer = kNoWall, .executor = *executor});
  maps.version = 7;
  ASSERT_EQ(maps.maps.size(), 1u);
  const std::string before = encode_particle_light(stage.world, maps);
  std::vector<float> drawn, shadowed, after;
  static_cast<void>(trace(stage, front(), WallTracer(50.0), drawn));
  EXPECT_EQ(encode_particle_light(stage.world, maps), before);
  EXPECT_FALSE(maps.per_pixel);
  EXPECT_GT(maps.version, 7u);
  EXPECT_EQ(maps.maps[0].static_lights, std::vector<Entity>{lamp});
  EXPECT_EQ(maps.maps[0].emitter, emitter);
  static_cast<void>(trace(stage, front(), kNoWall, after));
  EXPECT_EQ(after, drawn) << "the frame after a reference is the frame before it";
}

TEST_F(TracedParticles, are_kept_in_the_store_for_each_number_of_samples) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  stage.lamp({-2.0, 0.5, 1.0}, vec3(1.0f), 40.0f, 9.0f);
  const WallTracer wall(0.5);
  std::vector<float> drawn;
  const std::vector<float> first = trace(stage, front(), wall, drawn, 4);
  const std::size_t rays = wall.traced;
  EXPECT_GT(rays, 0u);
  EXPECT_EQ(trace(stage, front(), wall, drawn, 4), first);
  EXPECT_EQ(wall.traced, rays);
  EXPECT_NE(trace(stage, front(), wall, drawn, 8), first);
  EXPECT_EQ(store.kept.size(), 2u);
  for (auto& [identity, bytes] : store.kept) bytes.resize(bytes.size() / 2);
  EXPECT_EQ(trace(stage, front(), wall, drawn, 4), first) << "damaged results are traced again";
}

TEST_F(TracedParticles, are_none_without_an_emitter_in_view) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f), {0.0, 0.0, 100.0});
  std::vector<float> drawn;
  EXPECT_EQ(trace(stage, front(), kNoWall, drawn), drawn);
  EXPECT_TRUE(store.kept.empty());
}

TEST_F(TracedParticles, need_triangles_and_a_frame_that_is_drawn_again) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  const ViewSettings view = front();
  stage.draw(view);
  const FramePictures frame;
  const auto executor = make_serial_executor();
  ReferenceInput input = {.world = stage.world,
                          .view = stage.world.view_resource<RenderView>(view.id),
                          .knobs = stage.renderer->knobs(),
                          .frame = frame,
                          .samples = 1,
                          .executor = *executor};
  EXPECT_FALSE(draw_traced_particles(input).ok());
  input.redraw = [](const auto&, const auto&) -> Result<FramePictures> { return FramePictures{}; };
  EXPECT_FALSE(draw_traced_particles(input).ok());
  input.tracer = &kNoWall;
  EXPECT_TRUE(draw_traced_particles(input).ok());
}

}  // namespace
}  // namespace gloam::test
