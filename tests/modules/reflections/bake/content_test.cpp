// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "engine/scene/posing/animation.h"
#include "engine/scene/units.h"
#include "modules/reflections/scene_unit.h"
#include "tests/modules/reflections/bake/bake_world.h"
#include "tests/modules/reflections/bake/small_png.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using test::moved;

/// A scene with one of everything that a capture depends on.
struct ContentScene : test::BakeWorld {
  Entity camera, wall, cart, torch, swinging, proxy, probe;

  explicit ContentScene(const std::string& texture) {
    Material bricks;
    bricks.base_color_texture.texture = scene.texture(1, 1, {200, 100, 50, 255}, true);
    const std::uint32_t quad = scene.mesh(test::quad(1.0f, scene.material(bricks)));
    camera = world.create(Camera{}, WorldTransform{});
    wall = scene.draw(quad, moved(0, 0, -1));
    cart = scene.draw(scene.mesh(test::box(vec3(1.0f))), moved(3, 0, -1));
    torch = light("torch", Light{}, moved(0, 1, 0));
    swinging = light("swinging", Light{}, moved(5, 1, 0));
    world.add(cart, LocalTransform{});
    world.add(swinging, LocalTransform{});
    IbrProxy quad_proxy;
    quad_proxy.size_m = vec2(2.0f, 2.0f);
    quad_proxy.texture = text(texture);
    quad_proxy.lights = text("torch");
    proxy = world.create(quad_proxy, WorldTransform{});
    CubeProbe cube;
    cube.size_m = vec3(4.0f);
    probe = world.create(cube, WorldTransform{});
    AnimationClip clip;
    clip.channels.resize(1);
    clip.channels[0].times = {0.0f, 1.0f};
    clip.channels[0].values = {0, 0, 0, 1, 0, 0};
    scene.assets().clips.push_back(clip);
    world.resource<AnimationBindings>().poses = {{cart, 0, 0}, {swinging, 0, 0}};
  }
};

struct CaptureContent : testing::Test {
  test::TestFolder folder;
  std::string texture = folder.path() + "/fire.png";

  CaptureContent() { test::write_small_png(texture); }
  [[nodiscard]] bool changes_with(const std::function<void(ContentScene&)>& change) const {
    ContentScene scene(texture);
    const std::uint64_t before = capture_content(scene.world);
    change(scene);
    return capture_content(scene.world) != before;
  }
};

TEST_F(CaptureContent, is_the_same_in_two_worlds_of_one_scene) {
  EXPECT_EQ(capture_content(ContentScene(texture).world), capture_content(ContentScene(texture).world));
}

TEST_F(CaptureContent, changes_with_geometry_materials_and_places) {
  EXPECT_TRUE(changes_with([](auto& s) { s.scene.assets().meshes[0].primitives[0].positions[2].y += 0.01f; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.scene.assets().materials[0].roughness = 0.2f; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.scene.assets().images[0].rgba[1] = 101; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<WorldTransform>(s.wall).matrix[3].x = 0.5; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<MeshInstance>(s.wall).casts_shadows = false; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.scene.draw(0, moved(9, 0, 0)); }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template resource<SceneEnvironment>().sky_horizon.y = 1.0f; }));
}

TEST_F(CaptureContent, changes_with_lights_proxies_and_probes) {
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<Light>(s.torch).intensity = 3.0f; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<WorldTransform>(s.torch).matrix[3].y = 2.0; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.add(s.torch, ShadowCaster{.enabled = false}); }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<IbrProxy>(s.proxy).size_m.x = 3.0f; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<IbrProxy>(s.proxy).lights = s.text("swinging"); }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<IbrProxy>(s.proxy).kind = IbrProxyKind::fire; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<WorldTransform>(s.proxy).matrix[3].y = 2.0; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<CubeProbe>(s.probe).resolution = 64; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<CubeProbe>(s.probe).global = true; }));
  EXPECT_TRUE(changes_with([&](auto&) { std::ofstream(texture, std::ios::app) << "more"; }));
}

TEST_F(CaptureContent, changes_with_the_unit_of_length) {
  EXPECT_TRUE(changes_with([](auto& s) { s.world.set_resource(SceneUnits{0.01}); }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.set_resource(EstimatedUnit{0.01}); }));
  EXPECT_FALSE(changes_with([](auto& s) { s.world.set_resource(SceneUnits{1.0}); }));
}

TEST_F(CaptureContent, does_not_change_with_cameras_and_time) {
  EXPECT_FALSE(changes_with([](auto& s) { s.world.template get<WorldTransform>(s.camera).matrix[3].y = 2.0; }));
  EXPECT_FALSE(changes_with([](auto& s) { s.world.template get<Camera>(s.camera).fov_y = 2.0f; }));
  EXPECT_FALSE(changes_with([](auto& s) { s.world.create(Camera{}, WorldTransform{}); }));
  EXPECT_FALSE(changes_with([](auto& s) {
    for (const Entity entity : {s.cart, s.swinging}) {
      s.world.template get<WorldTransform>(entity).matrix[3].x = 77.0;
      s.world.template get<LocalTransform>(entity).translation.x = 77.0;
    }
  })) << "the pose of animated nodes";
  EXPECT_FALSE(changes_with([](auto& s) { s.world.template resource<SceneClock>().time_s = 5.0; }));
}

TEST_F(CaptureContent, changes_with_the_animation_of_a_light) {
  EXPECT_TRUE(changes_with([](auto& s) { s.scene.assets().clips[0].channels[0].values[3] = 2.0f; }));
  EXPECT_TRUE(changes_with([](auto& s) { s.world.template get<LocalTransform>(s.swinging).scale.x = 2.0; }));
}

}  // namespace
}  // namespace gloam
