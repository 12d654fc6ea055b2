// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/shadows.h"

#include <string>

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

constexpr int kBars = 9;
constexpr double kBarStep = 0.22;

struct ShadowMaterials {
  std::uint32_t floor, plaster, clay, iron, cloth;
};

ShadowMaterials add_shadow_materials(SceneBuilder& builder) {
  const auto material = [&](const char* name, vec3 color, float metallic, float roughness) {
    return builder.add_plain(name, color, roughness, metallic);
  };
  ShadowMaterials m{};
  m.floor = material("floor", vec3(0.42f, 0.40f, 0.37f), 0.0f, 0.85f);
  m.plaster = material("plaster", vec3(0.62f, 0.58f, 0.52f), 0.0f, 0.9f);
  m.clay = material("clay", vec3(0.52f, 0.20f, 0.12f), 0.0f, 0.7f);
  m.iron = material("iron", vec3(0.10f, 0.10f, 0.11f), 0.0f, 0.5f);
  Material cloth{.name = "cloth", .base_color = vec4(0.30f, 0.36f, 0.22f, 1.0f), .metallic = 0.0f, .roughness = 0.95f};
  cloth.double_sided = true;
  m.cloth = builder.add_material(cloth);
  return m;
}

/// A flat rectangle in the XZ plane, centred at the origin, facing up.
Primitive sheet_shape(float width_m, float depth_m) {
  Primitive sheet;
  const float x = width_m * 0.5f;
  const float z = depth_m * 0.5f;
  sheet.positions = {{-x, 0, -z}, {-x, 0, z}, {x, 0, z}, {x, 0, -z}};
  sheet.normals.assign(4, vec3(0.0f, 1.0f, 0.0f));
  sheet.indices = {0, 1, 2, 0, 2, 3};
  for (const vec3& position : sheet.positions) sheet.bounds.grow(position);
  return sheet;
}

void add_shadow_room(SceneBuilder& builder, const ShadowMaterials& m) {
  builder.add_instance("floor", builder.add_mesh("floor", box_shape({24.0f, 0.2f, 24.0f}), m.floor), {0.0, -0.2, 0.0});
  builder.add_instance("wall", builder.add_mesh("wall", box_shape({24.0f, 4.5f, 0.3f}), m.plaster), {0.0, 0.0, -4.0});
  const vec2 column[] = {{0.0f, 0.0f},   {0.34f, 0.0f}, {0.34f, 0.18f}, {0.24f, 0.26f},
                         {0.21f, 2.25f}, {0.3f, 2.35f}, {0.3f, 2.5f},   {0.0f, 2.5f}};
  const std::uint32_t mesh = builder.add_mesh("column", turned_shape(column, 32), m.plaster);
  for (int i = 0; i < 3; ++i) builder.add_instance("column " + std::to_string(i), mesh, {-3.6 + 1.7 * i, 0.0, -1.6});
}

void add_grille(SceneBuilder& builder, const ShadowMaterials& m) {
  const std::uint32_t bar = builder.add_mesh("bar", box_shape({0.05f, 1.8f, 0.05f}), m.iron);
  const std::uint32_t rail = builder.add_mesh("rail", box_shape({2.1f, 0.06f, 0.06f}), m.iron);
  for (int i = 0; i < kBars; ++i)
    builder.add_instance("bar " + std::to_string(i), bar, {1.4 + kBarStep * i, 0.0, -1.1});
  for (const double height : {0.3, 1.6})
    builder.add_instance("rail", rail, {1.4 + 0.5 * kBarStep * (kBars - 1), height, -1.1});
}

void add_table(SceneBuilder& builder, const ShadowMaterials& m) {
  const std::uint32_t leg = builder.add_mesh("leg", box_shape({0.06f, 0.72f, 0.06f}), m.clay);
  for (const double x : {-0.55, 0.55})
    for (const double z : {-0.35, 0.35}) builder.add_instance("leg", leg, {-0.6 + x, 0.0, 1.2 + z});
  builder.add_instance("table", builder.add_mesh("table", box_shape({1.3f, 0.04f, 0.9f}), m.clay), {-0.6, 0.72, 1.2});
  builder.add_instance("ball", builder.add_mesh("ball", sphere_shape(0.16f, 32), m.clay), {-0.6, 0.92, 1.2});
  const std::uint32_t sheet = builder.add_mesh("sheet", sheet_shape(0.8f, 0.6f), m.cloth);
  builder.add_instance("sheet on the floor", sheet, {1.2, 0.003, 1.3}, 0.3);
  builder.add_instance("sheet in the air", sheet, {2.5, 0.9, 0.9}, -0.4);
}

void add_shadow_lights(SceneBuilder& builder) {
  Light lamp;
  lamp.color = vec3(1.0f, 0.78f, 0.52f);
  lamp.intensity = 220.0f;
  lamp.range_m = 14.0f;
  lamp.width_m = 0.3f;
  builder.add_light("lamp", lamp, dvec3(-1.4, 3.4, 3.0), dvec3(0.0, -1.0, 0.0), true);
  Light spot;
  spot.kind = LightKind::spot;
  spot.color = vec3(0.62f, 0.74f, 1.0f);
  spot.intensity = 420.0f;
  spot.range_m = 14.0f;
  spot.inner_angle = 0.35f;
  spot.outer_angle = 0.6f;
  spot.width_m = 0.15f;
  builder.add_light("spot", spot, dvec3(4.6, 3.6, 2.6), dvec3(-0.62, -0.62, -0.75), true);
  Light moon;
  moon.kind = LightKind::directional;
  moon.color = vec3(0.55f, 0.65f, 1.0f);
  moon.intensity = 2.5f;
  moon.apparent_angle = 0.05f;
  builder.add_light("moon", moon, dvec3(0.0, 10.0, 0.0), dvec3(0.35, -0.8, -0.5), true);
}

}  // namespace

void build_shadows_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const ShadowMaterials materials = add_shadow_materials(builder);
  add_shadow_room(builder, materials);
  add_grille(builder, materials);
  add_table(builder, materials);
  add_shadow_lights(builder);
  builder.add_camera("main", {0.8, 2.6, 6.0}, {0.0, 0.5, -0.6}, 0.8f);
  builder.add_camera("close", {1.9, 0.55, 2.4}, {1.1, 0.0, 1.1}, 0.7f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.12f, 0.18f, 0.35f);
  environment.sky_horizon = vec3(0.5f, 0.4f, 0.42f);
  environment.sky_ground = vec3(0.1f, 0.09f, 0.08f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 3.4f;
  info.name = "shadows";
}

}  // namespace gloam
