// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Emitters that move in a world: by animations, by the host, and what lights them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "modules/particles/bake.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "tests/modules/particles/bake/bake_scene.h"

namespace gloam::test {
namespace {

/// A world with its scene systems and those of the particles.
struct MovingWorld : BakeScene {
  Schedule schedule;

  MovingWorld() {
    world.set_resource(EmitterSet{});
    world.set_resource(EmitterPaths{});
    world.set_resource(ParticleLightMaps{});
    world.set_resource(EmitterLights{});
    add_scene_systems(schedule);
    schedule.add_system("particle_emitters", "particles", Stage::world, &particle_emitters_system);
    schedule.add_system("particle_lights", "particles", Stage::world, &particle_lights_system);
  }
  /// The world's only emitter in the frame at a time.
  PlacedEmitter frame(double time_s, double dt_s = 1.0 / 60.0) {
    world.resource<SceneClock>() = {.time_s = time_s, .dt_s = dt_s};
    schedule.run(Stage::world, world, *make_serial_executor());
    world.resource<Teleports>().entities.clear();
    EXPECT_EQ(world.resource<EmitterSet>().emitters.size(), 1u);
    return world.resource<EmitterSet>().emitters.at(0);
  }
  /// An emitter that hangs from an animated node, which swings in a loop of 2 s; the emitter itself is turned.
  Entity add_animated() {
    AnimationChannel channel{.node = 0, .path = AnimationPath::translation};
    channel.times = {0.0f, 0.5f, 1.5f, 2.0f};
    channel.values = {0, 0, 0, 2, 0, 0, -2, 1, 0, 0, 0, 0};
    world.resource<SceneAssets>().clips.push_back({"swing", 2.0f, {channel}});
    const Entity parent = world.create(WorldTransform{}, LocalTransform{}, SourceNode{0});
    LocalTransform pose;
    pose.translation = dvec3(0.0, 1.0, 0.0);
    pose.rotation = dquat(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
    return world.create(WorldTransform{}, pose, Parent{parent, 1}, values());
  }
  static ParticleEmitter values() {
    return {.kind = EmitterKind::smoke, .rate = 50.0f, .lifetime_s = 2.0f, .box_m = vec3(0.2f)};
  }
  Entity add_hosted() { return world.create(WorldTransform{}, values()); }
  void put(Entity entity, const dvec3& at) {
    world.get<WorldTransform>(entity).matrix = glm::translate(dmat4(1.0), at);
    world.mark_changed<WorldTransform>(entity);
  }
};

dvec3 birth_at(const PlacedEmitter& emitter, double time_s) {
  if (emitter.path.empty()) return emitter.origin;
  for (std::size_t i = emitter.path.size() - 1; i > 0; --i) {
    const PlacedPose &a = emitter.path[i - 1], &b = emitter.path[i];
    if (a.time_s < time_s && time_s <= b.time_s)
      return glm::mix(a.origin, b.origin, (time_s - a.time_s) / (b.time_s - a.time_s));
  }
  return emitter.path.front().origin;
}

/// The swing by hand.
dvec3 swing(double t) {
  const double in_loop = t - 2.0 * std::floor(t / 2.0);
  const dvec3 right(2, 0, 0), left(-2, 1, 0);
  const dvec3 at = in_loop < 0.5   ? right * (in_loop / 0.5)
                   : in_loop < 1.5 ? glm::mix(right, left, in_loop - 0.5)
                                   : left * ((2.0 - in_loop) / 0.5);
  return at + dvec3(0.0, 1.0, 0.0);
}

void expect_same(const PlacedEmitter& a, const PlacedEmitter& b) {
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    EXPECT_EQ(a.path[i].time_s, b.path[i].time_s);
    EXPECT_EQ(a.path[i].origin, b.path[i].origin);
    EXPECT_EQ(a.path[i].axis, b.path[i].axis);
  }
}

TEST(MovingEmitters, of_animations_have_the_poses_of_the_animation) {
  MovingWorld moving;
  moving.add_animated();
  for (const double now : {7.3, 0.4, -3.1}) {
    const PlacedEmitter emitter = moving.frame(now);
    EXPECT_LT(glm::length(emitter.origin - swing(now)), 1e-9) << "where the transform system has it";
    for (double t = now - 2.0; t <= now; t += 0.013)
      EXPECT_LT(glm::length(birth_at(emitter, t) - swing(t)), 0.07) << "within the spacing of poses at a corner: " << t;
    for (const PlacedPose& pose : emitter.path) EXPECT_LT(glm::length(pose.origin - swing(pose.time_s)), 1e-6);
    EXPECT_NEAR(static_cast<double>(emitter.path[3].axis.x), -1.0, 1e-6) << "turned by its own rotation";
  }
}

TEST(MovingEmitters, of_animations_do_not_depend_on_earlier_frames) {
  MovingWorld played, sought, back, paused;
  for (MovingWorld* world : {&played, &sought, &back, &paused}) world->add_animated();
  for (int i = 0; i <= 300; ++i) static_cast<void>(played.frame(i / 60.0));
  for (int i = 600; i > 300; --i) static_cast<void>(back.frame(i / 60.0, -1.0 / 60.0));
  for (int i = 0; i < 5; ++i) static_cast<void>(paused.frame(5.0, 0.0));
  const PlacedEmitter wanted = sought.frame(5.0);
  EXPECT_GT(wanted.path.size(), 60u);
  expect_same(played.frame(5.0), wanted);
  expect_same(back.frame(5.0), wanted);
  expect_same(paused.frame(5.0, 0.0), wanted);
}

TEST(MovingEmitters, of_hosts_are_born_where_they_were) {
  MovingWorld hosted;
  const Entity entity = hosted.add_hosted();
  PlacedEmitter emitter;
  for (int i = 0; i <= 240; ++i) {
    hosted.put(entity, swing(i / 60.0));
    emitter = hosted.frame(i / 60.0);
  }
  for (double t = 2.0; t <= 4.0; t += 0.013) EXPECT_LT(glm::length(birth_at(emitter, t) - swing(t)), 0.07) << t;
  // The same history gives the same path, and a pause changes nothing.
  MovingWorld again;
  const Entity other = again.add_hosted();
  for (int i = 0; i <= 240; ++i) {
    again.put(other, swing(i / 60.0));
    static_cast<void>(again.frame(i / 60.0));
  }
  for (int i = 0; i < 9; ++i) expect_same(again.frame(4.0, 0.0), emitter);
  EXPECT_TRUE(hosted.frame(20.0).path.empty()) << "at rest after a seek forwards";
}

TEST(MovingEmitters, that_are_teleported_or_moved_while_the_clock_stands_have_no_particles_on_the_way) {
  for (const bool stands : {false, true}) {
    MovingWorld hosted;
    const Entity root = hosted.world.create(WorldTransform{});
    const Entity entity =
        hosted.world.create(WorldTransform{}, LocalTransform{}, Parent{root, 1}, MovingWorld::values());
    static_cast<void>(entity);
    for (int i = 0; i < 60; ++i) static_cast<void>(hosted.frame(i / 60.0));
    hosted.put(root, {30.0, 0.0, 0.0});
    if (!stands) hosted.world.resource<Teleports>().entities = {root};
    PlacedEmitter emitter = stands ? hosted.frame(59 / 60.0, 0.0) : hosted.frame(1.0);
    for (int i = 61; i < 90; ++i) emitter = hosted.frame(i / 60.0);
    for (double t = 0.0; t < 1.48; t += 0.001) {
      const double x = birth_at(emitter, t).x;
      EXPECT_LT(std::min(std::abs(x), std::abs(x - 30.0)), 1e-9) << t << ": " << x;
    }
    EXPECT_EQ(birth_at(emitter, 0.9).x, 0.0);
    EXPECT_EQ(birth_at(emitter, 1.1).x, 30.0);
    EXPECT_LT(emitter.bounds.min.x, 0.0);
    EXPECT_GT(emitter.bounds.max.x, 30.0);
  }
}

TEST(MovingEmitters, cost_nothing_at_rest_and_are_forgotten_when_they_are_gone) {
  MovingWorld hosted;
  const Entity entity = hosted.add_hosted(), other = hosted.world.create(WorldTransform{});
  for (int i = 0; i < 300; ++i) EXPECT_TRUE(hosted.frame(i / 60.0).path.empty());
  EXPECT_EQ(hosted.world.resource<EmitterPaths>().paths.at(entity).size(), 1u);
  hosted.world.destroy(entity);
  hosted.world.add(other, MovingWorld::values());
  static_cast<void>(hosted.frame(5.0));
  EXPECT_EQ(hosted.world.resource<EmitterPaths>().paths.size(), 1u);
}

TEST(MovingEmitters, take_light_from_the_volume_that_they_are_in) {
  MovingWorld hosted;
  hosted.world.register_component<Light>("light");
  const Entity entity = hosted.add_hosted();
  hosted.put(entity, {-3.0, 0.0, 0.0});
  hosted.add_lamp({-2.5, 0.5, 0.0});
  hosted.add_lamp({6.0, 0.5, 0.0});
  static_cast<void>(hosted.frame(0.0));
  ParticleLightMaps maps = hosted.bake(WallTracer(0.0));
  ASSERT_EQ(maps.maps.size(), 1u);
  // A volume around all of the way, and a larger one.
  ParticleLightMap hall = maps.maps[0], world = hall;
  hall.emitter = Entity{90, 1};
  hall.box = {vec3(0.0f, -9.0f, -9.0f), vec3(20.0f, 9.0f, 9.0f)};
  world.emitter = Entity{91, 1};
  world.box = {vec3(-90.0f), vec3(90.0f)};
  maps.maps.push_back(hall);
  maps.maps.push_back(world);
  mark_as_current(hosted.world, maps);
  hosted.world.resource<ParticleLightMaps>() = maps;
  const auto map = [&](double time_s, double x, bool jumps) {
    hosted.put(entity, {x, 0.0, 0.0});
    if (jumps) hosted.world.resource<Teleports>().entities = {entity};
    static_cast<void>(hosted.frame(time_s));
    return hosted.world.resource<EmitterLights>().emitters.at(0).map;
  };
  EXPECT_EQ(map(0.1, -3.0, false), 0u) << "its own, where it was baked";
  EXPECT_EQ(map(0.2, 5.0, true), 2u) << "its trail is not in the hall yet";
  EXPECT_EQ(map(1.1, 5.0, false), 2u);
  EXPECT_EQ(map(2.0, 5.0, false), 2u);
  EXPECT_EQ(map(2.5, 5.0, false), 1u);
  EXPECT_EQ(map(2.6, 5.1, false), 1u) << "it moves within the hall";
  EXPECT_EQ(map(9.0, 500.0, false), ~0u) << "outside of all volumes: the four strongest lamps";
  // The strongest lamp is that of where it is.
  hosted.world.resource<ParticleLightMaps>() = {};
  static_cast<void>(map(20.0, 5.5, false));
  const LightsOfEmitter right = hosted.world.resource<EmitterLights>().emitters.at(0);
  static_cast<void>(map(40.0, -3.0, false));
  const LightsOfEmitter left = hosted.world.resource<EmitterLights>().emitters.at(0);
  EXPECT_NE(right.lights[0].entity, left.lights[0].entity);
}

}  // namespace
}  // namespace gloam::test
