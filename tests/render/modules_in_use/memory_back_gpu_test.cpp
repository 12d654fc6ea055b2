// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Released views and worlds give all their GPU memory back, without a further frame.
#include <gmock/gmock.h>

#include <cstdio>
#include <map>
#include <string>

#include "modules/closeups/components.h"
#include "modules/depth_of_field/components.h"
#include "modules/fog/components.h"
#include "modules/glare/components.h"
#include "modules/grass/components.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "tests/render/draws/drawn_scene.h"

namespace gloam {
namespace {

using Bytes = std::map<std::string, std::uint64_t>;

/// The device's bytes by module, without modules that have none.
Bytes bytes_now() {
  Bytes bytes;
  for (const gpu::ModuleMemory& m : test::drawing_device()->memory())
    if (m.bytes > 0) bytes[m.module] = m.bytes;
  return bytes;
}

double mib(const Bytes& bytes) {
  double sum = 0.0;
  for (const auto& [module, count] : bytes) sum += static_cast<double>(count);
  return sum / 1048576.0;
}

void print_figures(const char* what, const Bytes& before, const Bytes& drawn, const Bytes& after) {
  std::printf("%s: %.2f MiB before, %.2f MiB drawn, %.2f MiB after\n", what, mib(before), mib(drawn), mib(after));
}

/// Fills a world that demands every module. Returns the camera.
Entity fill_with_every_effect(World& world) {
  test::fill_small_scene(world);
  test::add_lights(world);
  test::SceneMaker scene(world);
  Material mirror;
  mirror.metallic = 1.0f;
  mirror.roughness = 0.05f;
  const auto at = [](double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); };
  const Entity ball = scene.draw(scene.mesh(test::round_ball(0.6f, 16, 8, scene.material(mirror))), at(0, 0.2, 0));
  world.add(ball, CloseupSubject{.enabled = true});
  const Entity lawn = scene.draw(scene.mesh(test::box(vec3(1.0f, 0.05f, 1.0f))), at(1, -0.8, 3));
  world.add(lawn, GrassSurface{.density = 50.0f});
  ParticleEmitter smoke;
  smoke.kind = EmitterKind::smoke;
  world.create(WorldTransform{at(-1, 0, 2)}, smoke);
  world.create(Fog{0.05f, vec3(1.0f, 2.0f, 3.0f)});
  add_default_glare(world);
  const ViewSettings settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 96, 64);
  return world.create(WorldTransform{settings.world_from_camera}, Camera{},
                      DepthOfField{.focus_m = 6.0f, .f_number = 1.0f});
}

class MemoryBack : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(test::drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(test::drawing_device());
    ASSERT_THAT(bytes_now(), ::testing::IsEmpty());
    stage_ = std::make_unique<test::Stage>();
  }
  void TearDown() override {
    stage_.reset();
    if (test::drawing_device() != nullptr) {
      EXPECT_EQ(test::drawing_device()->validation_messages(), 0u);
    }
  }
  [[nodiscard]] static ViewRequest request(std::uint32_t id, Entity camera = kNoEntity) {
    ViewRequest view;
    view.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 96, 64);
    view.settings.id = ViewId{id};
    view.settings.camera_entity = camera;
    return view;
  }
  void draw(World& world, const std::vector<ViewRequest>& views, int frames = 5) {
    for (int i = 0; i < frames; ++i) {
      world.resource<SceneClock>().time_s += 0.1;
      const Status drawn = stage_->renderer->render(world, views);
      ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    }
  }
  void expect_every_module() {
    std::map<std::string, int> passes;
    for (const PassTime& pass : stage_->renderer->report().passes) ++passes[pass.module];
    for (const auto& module : stage_->renderer->modules())
      EXPECT_GT(passes[std::string(module->name())], 0) << module->name();
  }

  std::unique_ptr<test::Stage> stage_;
};

TEST_F(MemoryBack, a_released_world_returns_all) {
  Renderer& renderer = *stage_->renderer;
  World world;
  renderer.prepare_world(world);
  const Entity camera = fill_with_every_effect(world);
  const Bytes before = bytes_now();
  EXPECT_THAT(before, ::testing::IsEmpty());
  draw(world, {request(0, camera), request(1)});
  ASSERT_TRUE(renderer.wait().ok());
  expect_every_module();
  const Bytes drawn = bytes_now();
  renderer.release_world(world);
  print_figures("a world with every effect", before, drawn, bytes_now());
  EXPECT_EQ(bytes_now(), before);
  draw(world, {request(0, camera)}, 1);
  EXPECT_GT(mib(bytes_now()), 0.0) << "and it may be drawn again";
  renderer.release_world(world);
  EXPECT_EQ(bytes_now(), before);
}

// Hard case: passes.release_view
TEST_F(MemoryBack, a_released_view_returns_all_but_the_data_of_its_world) {
  Renderer& renderer = *stage_->renderer;
  const Entity camera = fill_with_every_effect(stage_->world);
  ViewRequest bare = request(7);  // uploads the world
  for (const auto& module : renderer.modules())
    if (module->name() != "lighting") bare.settings.without.emplace_back(module->name());
  draw(stage_->world, {bare});
  renderer.release_view(ViewId{7});
  const Bytes before = bytes_now();
  draw(stage_->world, {request(0, camera)});
  ASSERT_TRUE(renderer.wait().ok());
  expect_every_module();
  const Bytes drawn = bytes_now();
  renderer.release_view(stage_->world, ViewId{0});
  print_figures("a view with every effect", before, drawn, bytes_now());
  EXPECT_EQ(bytes_now(), before);
  draw(stage_->world, {request(0, camera)}, 2);
  renderer.release_view(stage_->world, ViewId{0});
  EXPECT_EQ(bytes_now(), before);
}

TEST_F(MemoryBack, a_view_released_beside_another_returns_what_it_added) {
  Renderer& renderer = *stage_->renderer;
  const Entity camera = fill_with_every_effect(stage_->world);
  ViewRequest plain = request(1);
  plain.settings.without = {"fog", "particles", "grass", "reflections", "closeups"};
  draw(stage_->world, {plain});
  renderer.release_view(ViewId{99});
  const auto settled = [&] {
    renderer.free_idle_memory();
    return bytes_now();
  };
  const Bytes before = settled();
  draw(stage_->world, {plain, request(0, camera)});
  const Bytes drawn = bytes_now();
  renderer.release_view(stage_->world, ViewId{0});
  const Bytes after = bytes_now();
  print_figures("a view beside another", before, drawn, after);
  for (const auto& [module, bytes] : after) EXPECT_LE(bytes, before.contains(module) ? before.at(module) : 0) << module;
  ASSERT_TRUE(renderer.wait().ok());
  draw(stage_->world, {plain});
  EXPECT_EQ(settled(), before) << "the other view needs as much as before";
}

TEST_F(MemoryBack, idle_memory_is_free_when_the_call_returns) {
  Renderer& renderer = *stage_->renderer;
  const Entity camera = fill_with_every_effect(stage_->world);
  ViewRequest view = request(0, camera);
  view.settings.without = {"shadows", "closeups"};  // an atlas of maps shrinks after 120 frames only
  draw(stage_->world, {view});
  renderer.free_idle_memory();
  const Bytes before = bytes_now();
  ViewRequest large = view;
  large.settings.width = 384;
  large.settings.height = 256;
  draw(stage_->world, {large}, 2);
  draw(stage_->world, {view}, 5);
  const Bytes drawn = bytes_now();
  renderer.free_idle_memory();
  print_figures("a view that was large for two frames", before, drawn, bytes_now());
  EXPECT_EQ(bytes_now(), before);
}

}  // namespace
}  // namespace gloam
