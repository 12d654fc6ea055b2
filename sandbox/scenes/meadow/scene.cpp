// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/meadow/scene.h"

#include <cmath>
#include <string>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/grass/components.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/meadow/ground.h"
#include "sandbox/scenes/meadow/motion.h"

namespace gloam {
namespace {

struct MeadowMaterials {
  std::uint32_t soil, path, hills, wood, iron, coat, trousers, skin, hat;
};

struct Ball {
  const char* name;
  float radius_m;
  vec3 color;
  MeadowLoop loop;
};

// A radius of √(n² − 1) radii of the ball brings a ball on level ground back after n turns.
constexpr Ball kBalls[kMeadowBalls] = {
    {"red ball", 0.35f, vec3(0.62f, 0.07f, 0.05f), {.x = -8.4, .z = 8.2, .radius_m = 2.42, .duration_s = 15.0}},
    {"blue ball", 0.25f, vec3(0.06f, 0.16f, 0.55f), {.x = 8.6, .z = 8.6, .radius_m = 1.98, .duration_s = 12.0}},
    {"yellow ball", 0.5f, vec3(0.70f, 0.46f, 0.05f), {.x = 0.2, .z = 0.2, .radius_m = 2.45, .duration_s = 20.0}},
    {"green ball", 0.4f, vec3(0.05f, 0.36f, 0.16f), {.x = -8.6, .z = -8.6, .radius_m = 2.37, .duration_s = 15.0}},
};

constexpr MeadowLoop kWalkerLoop = {
    .radius_m = 5.4, .wave = 0.12, .waves = 3, .duration_s = 30.0, .start = 0.35, .backwards = true};
constexpr MeadowLoop kCameraLoop = {
    .radius_m = 6.4, .wave = 0.4, .waves = 1, .turns = 2, .duration_s = kMeadowRound_s, .start = 0.3};

struct Pole {
  double x, z, heading;  // the arm points along the local +X
};
constexpr Pole kPoles[kMeadowLanterns] = {
    {1.15, 0.2, 3.1}, {1.4, 9.3, 3.0}, {-1.5, -9.7, 0.3}, {7.4, -0.6, 1.2}, {-8.7, 1.2, -1.0}};

MeadowMaterials add_meadow_materials(SceneBuilder& builder) {
  const auto material = [&](const char* name, vec3 color, float roughness) {
    return builder.add_plain(name, color, roughness);
  };
  MeadowMaterials m{};
  m.soil = material("soil", vec3(0.085f, 0.105f, 0.038f), 0.95f);
  m.path = material("path", vec3(0.30f, 0.21f, 0.13f), 0.95f);
  m.hills = material("hills", vec3(0.075f, 0.105f, 0.042f), 0.95f);
  m.wood = material("wood", vec3(0.32f, 0.20f, 0.10f), 0.8f);
  m.iron = material("iron", vec3(0.06f, 0.06f, 0.065f), 0.5f);
  m.coat = material("coat", vec3(0.36f, 0.09f, 0.07f), 0.85f);
  m.trousers = material("trousers", vec3(0.07f, 0.08f, 0.12f), 0.9f);
  m.skin = material("skin", vec3(0.66f, 0.46f, 0.36f), 0.6f);
  m.hat = material("hat", vec3(0.16f, 0.11f, 0.07f), 0.8f);
  return m;
}

void add_meadow_ground(World& world, SceneBuilder& builder, const MeadowMaterials& m) {
  MeadowGround ground = meadow_ground_shapes();
  const double area = upward_area_m2(ground.field);
  const std::uint32_t field = builder.add_mesh("field", std::move(ground.field), m.soil);
  const Entity entity = builder.add_instance("field", field, dvec3(0.0));
  world.add<GrassSurface>(entity, {.density = static_cast<float>(kMeadowBlades / area),
                                   .height_m = vec2(0.3f, 0.06f),
                                   .width_m = 0.006f,
                                   .max_distance_m = 40.0f});
  builder.add_instance("path", builder.add_mesh("path", std::move(ground.path), m.path), dvec3(0.0));
  builder.add_instance("hills", builder.add_mesh("hills", std::move(ground.hills), m.hills), dvec3(0.0));
  world.add<Wind>(builder.add_group("wind", dvec3(0.0)), {.velocity = vec3(2.8f, 0.0f, 1.3f), .gust = 0.4f});
}

/// A sphere with six stripes of two colours, which show that it rolls.
Primitive ball_shape(float radius_m) {
  const Primitive sphere = sphere_shape(radius_m, 48);
  Primitive ball;
  ball.bounds = sphere.bounds;
  for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
    vec3 middle(0.0f);
    for (std::size_t k = i; k < i + 3; ++k) middle += sphere.positions[sphere.indices[k]];
    const float stripe = std::floor(6.0f * (std::atan2(middle.z, middle.x) / (2.0f * kPi) + 1.0f));
    const vec4 color = std::fmod(stripe, 2.0f) == 0.0f ? vec4(1.0f) : vec4(vec3(0.22f), 1.0f);
    for (std::size_t k = i; k < i + 3; ++k) {
      ball.indices.push_back(static_cast<std::uint32_t>(ball.positions.size()));
      ball.positions.push_back(sphere.positions[sphere.indices[k]]);
      ball.normals.push_back(sphere.normals[sphere.indices[k]]);
      ball.colors.push_back(color);
    }
  }
  return ball;
}

void add_balls(World& world, SceneBuilder& builder) {
  for (const Ball& ball : kBalls) {
    const std::string name = ball.name;
    const std::uint32_t paint =
        builder.add_material({.name = name, .base_color = vec4(ball.color, 1.0f), .metallic = 0.0f, .roughness = 0.4f});
    const std::vector<PoseKey> keys = rolling_keys(ball.loop, double{ball.radius_m});
    const Entity entity =
        builder.add_instance(name, builder.add_mesh(name, ball_shape(ball.radius_m), paint), keys.front().translation);
    world.add<Collider>(entity, {.shape = ColliderShape::sphere, .radius_m = ball.radius_m});
    builder.add_clip(name, entity, keys);
  }
}

void add_walker(World& world, SceneBuilder& builder, const MeadowMaterials& m) {
  const std::vector<PoseKey> keys = walking_keys(kWalkerLoop);
  const Entity walker = builder.add_group("walker", keys.front().translation);
  world.add<Collider>(walker, {.shape = ColliderShape::capsule, .radius_m = 0.25f, .height_m = 1.8f});
  builder.add_clip("walker", walker, keys);
  const auto add = [&](const char* name, const Primitive& shape, std::uint32_t material, dvec3 at) {
    const Entity part = builder.add_instance(name, builder.add_mesh(name, shape, material), at);
    world.add(part, Parent{walker, 1});
    return part;
  };
  const vec2 body[] = {{0.0f, 0.0f},   {0.13f, 0.02f}, {0.19f, 0.12f}, {0.17f, 0.4f},
                       {0.21f, 0.62f}, {0.18f, 0.74f}, {0.06f, 0.8f},  {0.0f, 0.8f}};
  const vec2 brim[] = {{0.0f, 0.0f}, {0.19f, 0.0f}, {0.2f, 0.01f}, {0.12f, 0.02f}, {0.1f, 0.11f}, {0.0f, 0.13f}};
  add("body", turned_shape(body, 32), m.coat, {0.0, 0.72, 0.0});
  add("head", sphere_shape(0.115f, 32), m.skin, {0.0, 1.6, 0.0});
  add("hat", turned_shape(brim, 32), m.hat, {0.0, 1.66, 0.0});

  // Limbs hang from their joints.
  Primitive leg, arm;
  append_shape(leg, box_shape({0.13f, 0.84f, 0.15f}), {0.0f, -0.84f, 0.0f});
  append_shape(arm, box_shape({0.08f, 0.58f, 0.09f}), {0.0f, -0.58f, 0.0f});
  constexpr double kStride_s = 1.0;
  struct Limb {
    const char* name;
    bool is_leg;
    dvec3 joint;
    double swing;
  };
  const Limb limbs[] = {{"left leg", true, {0.1, 0.84, 0.0}, 0.36},
                        {"right leg", true, {-0.1, 0.84, 0.0}, -0.36},
                        {"left arm", false, {0.24, 1.4, 0.0}, -0.4},
                        {"right arm", false, {-0.24, 1.4, 0.0}, 0.4}};
  for (const Limb& limb : limbs) {
    const Entity part = add(limb.name, limb.is_leg ? leg : arm, limb.is_leg ? m.trousers : m.coat, limb.joint);
    builder.add_clip(limb.name, part, swinging_keys(limb.joint, limb.swing, kStride_s));
  }
}

void add_crates(World& world, SceneBuilder& builder, const MeadowMaterials& m) {
  struct Crate {
    const char* name;
    double x, z, heading;
    float size_m;
  };
  constexpr Crate kCrates[] = {{"large crate", 4.4, 10.0, 0.5, 0.8f}, {"small crate", 3.4, -9.3, -0.3, 0.55f}};
  for (const Crate& crate : kCrates) {
    const float half = 0.5f * crate.size_m, plank = 0.12f * crate.size_m;
    Primitive shape;  // centred, as the collider is
    append_shape(shape, box_shape(vec3(crate.size_m - 0.04f)), {0.0f, 0.02f - half, 0.0f});
    for (const float y : {-half, half - plank})
      append_shape(shape, box_shape({crate.size_m, plank, crate.size_m}), {0.0f, y, 0.0f});
    for (const float x : {-1.0f, 1.0f})
      for (const float z : {-1.0f, 1.0f})
        append_shape(shape, box_shape({plank, crate.size_m, plank}),
                     {x * 0.5f * (crate.size_m - plank), -half, z * 0.5f * (crate.size_m - plank)});
    const Entity entity = builder.add_instance(crate.name, builder.add_mesh(crate.name, shape, m.wood),
                                               meadow_point(crate.x, crate.z, double{half} - 0.06), crate.heading);
    world.add<Collider>(entity, {.shape = ColliderShape::box, .size_m = vec3(crate.size_m)});
  }
}

/// Poles, each with an arm from which a bulb hangs below a hood.
void add_meadow_lanterns(SceneBuilder& builder, const MeadowMaterials& m, bool are_lit) {
  constexpr vec3 kWarm(1.0f, 0.66f, 0.32f);
  const vec2 shaft[] = {{0.0f, -0.3f}, {0.06f, -0.3f}, {0.05f, 0.3f}, {0.03f, 0.4f}, {0.022f, 2.3f}, {0.0f, 2.32f}};
  const vec2 hood[] = {{0.0f, 0.05f}, {0.05f, 0.05f}, {0.16f, 0.0f}, {0.17f, 0.01f}, {0.07f, 0.1f}, {0.0f, 0.14f}};
  Primitive pole = turned_shape(shaft, 12);
  append_shape(pole, box_shape({0.46f, 0.03f, 0.03f}), {0.22f, 2.22f, 0.0f});
  append_shape(pole, turned_shape(hood, 18), {0.42f, 2.1f, 0.0f});
  const std::uint32_t pole_mesh = builder.add_mesh("pole", pole, m.iron);
  const Material glow{.name = "bulb",
                      .base_color = vec4(are_lit ? vec3(0.02f) : vec3(0.8f, 0.76f, 0.66f), 1.0f),
                      .emissive = are_lit ? kWarm * 24.0f : vec3(0.0f),
                      .metallic = 0.0f,
                      .roughness = 0.6f};
  const std::uint32_t bulb_mesh = builder.add_mesh("bulb", sphere_shape(0.075f, 16), builder.add_material(glow));
  Light light;
  light.kind = LightKind::spot;  // the hood keeps the light from the sky
  light.inner_angle = 0.85f;
  light.outer_angle = 1.2f;
  light.color = kWarm;
  light.intensity = 18.0f;
  light.range_m = 9.0f;
  light.width_m = 0.14f;
  int count = 0;
  for (const Pole& pole_at : kPoles) {
    const std::string number = std::to_string(++count);
    const dvec3 foot = meadow_point(pole_at.x, pole_at.z);
    const dvec3 bulb = foot + dvec3(0.42 * std::cos(pole_at.heading), 1.99, -0.42 * std::sin(pole_at.heading));
    builder.add_instance("pole " + number, pole_mesh, foot, pole_at.heading);
    builder.add_instance("bulb " + number, bulb_mesh, bulb);
    if (are_lit) builder.add_light("lantern " + number, light, bulb, {0.0, -1.0, 0.0}, true);
  }
}

void add_meadow_cameras(SceneBuilder& builder) {
  builder.add_camera("near", meadow_point(-3.2, 11.3, 1.2), meadow_point(-4.8, 4.0, 0.6), 0.85f);
  builder.add_camera("far", meadow_point(-15.0, 15.2, 1.6), meadow_point(0.5, -0.5, 0.0), 0.8f);
  builder.add_camera("ground", meadow_point(-7.3, -3.1, 0.35), meadow_point(0.0, 1.2, 0.8), 0.9f);
  builder.add_camera("lanterns", meadow_point(4.4, 4.6, 1.5), meadow_point(1.0, 0.2, 0.7), 0.9f);
  const dvec3 above = meadow_point(0.0, 8.0, 11.0);
  builder.add_camera("above", above, above + dvec3(0.0, -std::sqrt(3.0), -1.0), 0.95f);
  const std::vector<PoseKey> walk = looking_keys(kCameraLoop, 1.65);
  builder.add_clip("walk", builder.add_camera("walk", walk.front().translation, dvec3(0.0), 0.95f), walk);
}

/// In what the meadows by night and by day differ.
struct Meadow {
  const char* name;
  bool lanterns_are_lit;
  const char* light_name;  ///< of the directional light
  Light light;
  dvec3 light_direction;
  SceneEnvironment sky;
};

void build_meadow(World& world, SceneInfo& info, Meadow meadow) {
  SceneBuilder builder(world, info);
  const MeadowMaterials materials = add_meadow_materials(builder);
  add_meadow_ground(world, builder, materials);
  add_balls(world, builder);
  add_walker(world, builder, materials);
  add_crates(world, builder, materials);
  add_meadow_lanterns(builder, materials, meadow.lanterns_are_lit);
  add_meadow_cameras(builder);
  meadow.light.kind = LightKind::directional;
  builder.add_light(meadow.light_name, meadow.light, {0.0, 20.0, 0.0}, meadow.light_direction, true);
  world.resource<SceneEnvironment>() = meadow.sky;
  info.name = meadow.name;
}

}  // namespace

void build_meadow_scene(World& world, SceneInfo& info) {
  Light moon;
  moon.color = vec3(0.55f, 0.67f, 1.0f);
  moon.intensity = 1.6f;
  moon.apparent_angle = 0.05f;
  build_meadow(world, info,
               {.name = "meadow",
                .lanterns_are_lit = true,
                .light_name = "moon",
                .light = moon,
                .light_direction = {0.55, -0.62, -0.4},
                .sky = {.sky_zenith = vec3(0.016f, 0.028f, 0.072f),
                        .sky_horizon = vec3(0.075f, 0.092f, 0.150f),
                        .sky_ground = vec3(0.020f, 0.024f, 0.022f),
                        .has_exposure = true,
                        .exposure_ev100 = 0.1f}});
}

void build_meadow_day_scene(World& world, SceneInfo& info) {
  Light sun;
  sun.color = vec3(1.0f, 0.90f, 0.74f);
  sun.intensity = 24000.0f;
  build_meadow(world, info,
               {.name = "meadow_day",
                .lanterns_are_lit = false,
                .light_name = "sun",
                .light = sun,
                .light_direction = {0.6, -0.72, -0.35},
                .sky = {.sky_zenith = vec3(700.0f, 1300.0f, 2700.0f),
                        .sky_horizon = vec3(2300.0f, 2700.0f, 3200.0f),
                        .sky_ground = vec3(480.0f, 500.0f, 360.0f),
                        .has_exposure = true,
                        .exposure_ev100 = 12.0f}});
}

}  // namespace gloam
