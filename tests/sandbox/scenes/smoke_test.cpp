// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/smoke.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/visible.h"
#include "modules/reflections/components.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

struct SmokeWorld {
  SmokeWorld() {
    const ModuleList modules = make_all_modules();
    prepare_world(world, modules);
    const auto executor = make_serial_executor();
    const auto loaded = load_scene({.scene = "builtin:smoke"}, modules, world, *executor, null_log());
    EXPECT_TRUE(loaded.ok());
    Schedule schedule;
    add_scene_systems(schedule);
    schedule.run(Stage::world, world, *executor);
    world.view<const ParticleEmitter, const WorldTransform>().each(
        [&](Entity entity, const ParticleEmitter& emitter, const WorldTransform& transform) {
          PlacedEmitter placed;
          EXPECT_TRUE(emits(emitter) && place_emitter(entity, emitter, transform.matrix, placed));
          emitters.push_back(placed);
        });
  }
  [[nodiscard]] std::size_t seen_by(const std::string& camera) {
    const auto entity = world.resource<SceneNames>().find("camera", camera);
    EXPECT_TRUE(entity.ok());
    const RenderView view = make_view(settings_for_camera(world, *entity, 640, 360), 0);
    return find_visible_emitters(emitters, view, 0).emitters.size();
  }
  World world;
  std::vector<PlacedEmitter> emitters;
};

TEST(SmokeScene, has_emitters_of_all_kinds) {
  SmokeWorld scene;
  EXPECT_EQ(scene.emitters.size(), std::size_t{kSmokeEmitters});
  for (const EmitterKind kind : {EmitterKind::fog, EmitterKind::dust, EmitterKind::smoke, EmitterKind::fire}) {
    bool found = false;
    for (const PlacedEmitter& emitter : scene.emitters) found = found || emitter.values.kind == kind;
    EXPECT_TRUE(found) << static_cast<int>(kind);
  }
}

TEST(SmokeScene, is_seen_by_all_cameras_but_away) {
  SmokeWorld scene;
  for (const char* camera : {"near", "far", "fire", "beam", "inside"}) EXPECT_GT(scene.seen_by(camera), 1u) << camera;
  EXPECT_EQ(scene.seen_by("away"), 0u);
}

TEST(SmokeScene, its_fire_has_reflection_proxies) {
  SmokeWorld scene;
  std::size_t proxies = 0;
  scene.world.view<const IbrProxy, const FlameProxy>().each([&](const IbrProxy& proxy, const FlameProxy& flame) {
    ++proxies;
    EXPECT_EQ(proxy.kind, IbrProxyKind::fire);
    EXPECT_EQ(scene.world.get<ParticleEmitter>(flame.flame).kind, EmitterKind::fire);
  });
  EXPECT_EQ(proxies, 4u);
}

}  // namespace
}  // namespace gloam
