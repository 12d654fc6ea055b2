// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/smoke.h"

#include <string>

#include "engine/scene/resources.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

constexpr vec3 kFirelight(1.0f, 0.40f, 0.10f), kCold(0.12f, 0.38f, 1.0f);
constexpr dvec3 kVent(0.0, 0.0, 0.0);    // the smoke comes from here
constexpr dvec3 kBowl(3.4, 0.0, 1.6);    // the fire burns here
constexpr dvec3 kSpot(-4.6, 3.4, -1.5);  // the dust is in its beam
constexpr double kLampX = 1.7;

struct SmokeMaterials {
  std::uint32_t stone, wall, iron, water, warm, cold, ember;
};

SmokeMaterials add_smoke_materials(SceneBuilder& builder) {
  const auto material = [&](const char* name, vec3 color, float roughness) {
    return builder.add_plain(name, color, roughness);
  };
  const auto glow = [&](const char* name, vec3 luminance) { return builder.add_glow(name, luminance); };
  SmokeMaterials m{};
  m.stone = material("stone", vec3(0.20f, 0.19f, 0.18f), 0.9f);
  m.wall = material("wall", vec3(0.26f, 0.22f, 0.19f), 0.95f);
  m.iron = material("iron", vec3(0.05f, 0.05f, 0.055f), 0.6f);
  m.water = material("water", vec3(0.02f, 0.02f, 0.022f), 0.04f);
  m.warm = glow("warm bulb", kFirelight * 30.0f);
  m.cold = glow("cold bulb", kCold * 30.0f);
  m.ember = glow("embers", vec3(2.2f, 0.5f, 0.08f));
  return m;
}

void add_courtyard(SceneBuilder& builder, const SmokeMaterials& m) {
  builder.add_instance("floor", builder.add_mesh("floor", box_shape({18.0f, 0.4f, 14.0f}), m.stone), {0.0, -0.4, 0.0});
  const std::uint32_t wall = builder.add_mesh("wall", box_shape({18.0f, 4.2f, 0.4f}), m.wall);
  builder.add_instance("back wall", wall, {0.0, 0.0, -5.2});
  builder.add_instance("left wall", builder.add_mesh("side wall", box_shape({0.4f, 4.2f, 10.0f}), m.wall),
                       {-8.0, 0.0, -0.2});
  const std::uint32_t pillar = builder.add_mesh("pillar", box_shape({0.5f, 3.2f, 0.5f}), m.wall);
  for (const double x : {-6.0, -3.0, 3.0, 6.0}) builder.add_instance("pillar", pillar, {x, 0.0, -4.2});
  const std::uint32_t crate = builder.add_mesh("crate", box_shape({0.7f, 0.7f, 0.7f}), m.wall);
  builder.add_instance("crate", crate, {-2.6, 0.0, -2.2}, 0.4);
  builder.add_instance("upper crate", crate, {-2.5, 0.7, -2.3}, 0.9, dvec3(0.7));
  const vec2 vent[] = {{0.0f, 0.0f}, {0.34f, 0.0f}, {0.34f, 0.26f}, {0.24f, 0.26f}, {0.24f, 0.1f}, {0.0f, 0.1f}};
  builder.add_instance("vent", builder.add_mesh("vent", turned_shape(vent, 24), m.iron), kVent);
}

void add_lamp(SceneBuilder& builder, const SmokeMaterials& m, const char* name, double x, vec3 color,
              std::uint32_t bulb) {
  const vec2 post[] = {{0.0f, 0.0f}, {0.09f, 0.0f}, {0.03f, 0.1f}, {0.03f, 1.5f}, {0.07f, 1.54f}, {0.0f, 1.56f}};
  const std::string lamp = name;
  builder.add_instance(lamp + " post", builder.add_mesh(lamp + " post", turned_shape(post, 16), m.iron), {x, 0.0, 0.1});
  builder.add_instance(lamp + " bulb", builder.add_mesh(lamp + " bulb", sphere_shape(0.07f, 20), bulb), {x, 1.64, 0.1});
  Light light;
  light.color = color;
  light.intensity = 30.0f;
  light.range_m = 9.0f;
  light.width_m = 0.14f;
  builder.add_light(lamp, light, {x, 1.64, 0.1}, {0.0, -1.0, 0.0}, true);
}

Entity add_emitter(World& world, SceneBuilder& builder, const char* name, const dvec3& at,
                   const ParticleEmitter& emitter) {
  const Entity entity = builder.add_group(name, at);
  world.add(entity, emitter);
  return entity;
}

void add_smoke(World& world, SceneBuilder& builder) {
  add_emitter(world, builder, "smoke", kVent + dvec3(0.0, 0.2, 0.0),
              {.kind = EmitterKind::smoke,
               .rate = 70.0f,
               .lifetime_s = 6.0f,
               .size_m = 0.3f,
               .speed = 0.9f,
               .spread = 0.16f,
               .box_m = vec3(0.3f, 0.05f, 0.3f)});
}

/// A bowl of embers on a wet floor, with flames, their smoke and the proxy that stands for them in the water.
void add_smoke_fire(World& world, SceneBuilder& builder, const SmokeMaterials& m) {
  const vec2 bowl[] = {{0.0f, 0.0f},   {0.22f, 0.0f},  {0.1f, 0.08f},  {0.1f, 0.3f},
                       {0.36f, 0.46f}, {0.42f, 0.56f}, {0.38f, 0.56f}, {0.3f, 0.46f}};
  builder.add_instance("bowl", builder.add_mesh("bowl", turned_shape(bowl, 32), m.iron), kBowl);
  const vec2 embers[] = {{0.31f, 0.46f}, {0.2f, 0.5f}, {0.0f, 0.52f}};
  builder.add_instance("embers", builder.add_mesh("embers", turned_shape(embers, 24), m.ember), kBowl);
  const vec2 pool[] = {{2.1f, 0.0f}, {2.0f, 0.006f}, {0.0f, 0.006f}};
  builder.add_instance("pool", builder.add_mesh("pool", turned_shape(pool, 48), m.water), kBowl + dvec3(0.1, 0.0, 0.9));
  const dvec3 flames = kBowl + dvec3(0.0, 0.52, 0.0);
  add_emitter(world, builder, "fire", flames,
              {.kind = EmitterKind::fire,
               .rate = 90.0f,
               .lifetime_s = 0.9f,
               .size_m = 0.34f,
               .speed = 0.5f,
               .spread = 0.3f,
               .box_m = vec3(0.4f, 0.04f, 0.4f)});
  add_emitter(world, builder, "smoke of the fire", flames + dvec3(0.0, 0.7, 0.0),
              {.kind = EmitterKind::smoke,
               .rate = 14.0f,
               .lifetime_s = 4.0f,
               .size_m = 0.22f,
               .speed = 0.8f,
               .spread = 0.2f,
               .box_m = vec3(0.2f, 0.1f, 0.2f)});
  Light light;
  light.color = vec3(1.0f, 0.46f, 0.14f);
  light.intensity = 22.0f;
  light.range_m = 8.0f;
  light.width_m = 0.2f;
  builder.add_light("fire light", light, flames + dvec3(0.0, 0.35, 0.0), {0.0, -1.0, 0.0}, true);
}

void add_beam(World& world, SceneBuilder& builder, const SmokeMaterials& m) {
  const dvec3 target(-4.0, 0.0, 1.2);
  const vec2 hood[] = {{0.0f, 0.2f}, {0.06f, 0.18f}, {0.13f, 0.0f}, {0.12f, 0.0f}, {0.05f, 0.16f}};
  builder.add_instance("spot", builder.add_mesh("spot", turned_shape(hood, 20), m.iron), kSpot);
  Light light;
  light.kind = LightKind::spot;
  light.color = vec3(1.0f, 0.9f, 0.72f);
  light.intensity = 220.0f;
  light.range_m = 9.0f;
  light.inner_angle = 0.22f;
  light.outer_angle = 0.3f;
  light.width_m = 0.1f;
  builder.add_light("spot light", light, kSpot, target - kSpot, true);
  add_emitter(world, builder, "dust", {-4.3, 1.7, -0.15},
              {.kind = EmitterKind::dust,
               .rate = 420.0f,
               .lifetime_s = 10.0f,
               .size_m = 0.016f,
               .speed = 0.03f,
               .spread = kPi,
               .box_m = vec3(3.4f, 3.2f, 4.0f)});
}

void add_ground_fog(World& world, SceneBuilder& builder) {
  add_emitter(world, builder, "ground fog", {0.0, 0.16, -0.6},
              {.kind = EmitterKind::fog,
               .rate = 14.0f,
               .lifetime_s = 12.0f,
               .size_m = 1.3f,
               .speed = 0.04f,
               .spread = kPi,
               .box_m = vec3(12.0f, 0.25f, 8.0f)});
}

void add_smoke_cameras(SceneBuilder& builder) {
  builder.add_camera("near", {0.3, 1.35, 4.6}, {0.0, 1.5, 0.0}, 0.75f);
  builder.add_camera("far", {1.2, 2.9, 11.5}, {-0.2, 1.1, -1.0}, 0.7f);
  builder.add_camera("fire", {4.2, 1.0, 6.2}, {3.5, 0.2, 2.0}, 0.62f);
  builder.add_camera("beam", {-2.4, 1.5, 4.4}, {-4.3, 1.5, -0.3}, 0.8f);
  builder.add_camera("inside", {0.05, 1.3, 0.25}, {0.5, 1.6, -4.0}, 1.0f);
  builder.add_camera("away", {0.0, 1.6, 9.0}, {0.0, 1.9, 20.0}, 0.8f);
}

}  // namespace

void build_smoke_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const SmokeMaterials m = add_smoke_materials(builder);
  add_courtyard(builder, m);
  add_lamp(builder, m, "warm lamp", -kLampX, kFirelight, m.warm);
  add_lamp(builder, m, "cold lamp", kLampX, kCold, m.cold);
  add_smoke(world, builder);
  add_smoke_fire(world, builder, m);
  add_beam(world, builder, m);
  add_ground_fog(world, builder);
  add_smoke_cameras(builder);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.010f, 0.014f, 0.030f);
  environment.sky_horizon = vec3(0.030f, 0.034f, 0.050f);
  environment.sky_ground = vec3(0.010f, 0.010f, 0.010f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 0.9f;
  info.name = "smoke";
}

}  // namespace gloam
