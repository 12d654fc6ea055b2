// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/closeups.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/closeups/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

struct CloseUpMaterials {
  std::uint32_t floor, wall, wood;
  std::array<std::uint32_t, kCloseupFigures> coats;
  std::uint32_t skin;
};

CloseUpMaterials add_close_up_materials(SceneBuilder& builder) {
  const auto material = [&](const std::string& name, vec3 color, float roughness) {
    return builder.add_plain(name, color, roughness);
  };
  CloseUpMaterials m{};
  m.floor = material("floor", vec3(0.40f, 0.38f, 0.35f), 0.8f);
  m.wall = material("wall", vec3(0.58f, 0.52f, 0.46f), 0.9f);
  m.wood = material("wood", vec3(0.30f, 0.20f, 0.12f), 0.7f);
  m.skin = material("skin", vec3(0.66f, 0.46f, 0.36f), 0.6f);
  constexpr std::array<vec3, kCloseupFigures> kCoats = {{{0.45f, 0.10f, 0.10f},
                                                         {0.12f, 0.22f, 0.42f},
                                                         {0.16f, 0.34f, 0.16f},
                                                         {0.48f, 0.38f, 0.12f},
                                                         {0.32f, 0.14f, 0.36f},
                                                         {0.42f, 0.40f, 0.38f},
                                                         {0.10f, 0.32f, 0.34f},
                                                         {0.46f, 0.24f, 0.10f}}};
  for (std::size_t i = 0; i < kCoats.size(); ++i) m.coats[i] = material("coat " + std::to_string(i), kCoats[i], 0.85f);
  return m;
}

/// One mesh of a figure, placed relative to the figure's root.
struct CloseUpPart {
  const char* name;
  std::uint32_t mesh;
  dvec3 at;
  dvec3 scale = dvec3(1.0);
};

std::vector<CloseUpPart> figure_parts(SceneBuilder& builder, const CloseUpMaterials& m, std::size_t figure) {
  const vec2 coat[] = {{0.0f, 0.0f},  {0.24f, 0.0f},  {0.26f, 0.06f}, {0.19f, 0.55f}, {0.15f, 0.85f},
                       {0.2f, 1.15f}, {0.17f, 1.28f}, {0.05f, 1.36f}, {0.0f, 1.38f}};
  const std::uint32_t body = builder.add_mesh("coat", turned_shape(coat, 32), m.coats[figure]);
  const std::uint32_t ball = builder.add_mesh("head", sphere_shape(0.115f, 32), m.skin);
  const std::uint32_t bar = builder.add_mesh("arm", box_shape({0.07f, 0.56f, 0.07f}), m.coats[figure]);
  const std::uint32_t finger = builder.add_mesh("finger", box_shape({0.012f, 0.09f, 0.012f}), m.skin);
  const vec2 brim[] = {{0.0f, 0.0f}, {0.2f, 0.0f}, {0.21f, 0.01f}, {0.12f, 0.02f}, {0.1f, 0.13f}, {0.0f, 0.15f}};
  const std::uint32_t hat = builder.add_mesh("hat", turned_shape(brim, 32), m.coats[(figure + 3) % m.coats.size()]);
  std::vector<CloseUpPart> parts = {{"coat", body, {0.0, 0.0, 0.0}},
                                    {"head", ball, {0.0, 1.5, 0.0}},
                                    {"hat", hat, {0.0, 1.56, 0.0}},
                                    {"left arm", bar, {-0.25, 0.66, 0.04}},
                                    {"right arm", bar, {0.25, 0.66, 0.04}}};
  for (const double side : {-0.25, 0.25})
    for (int i = 0; i < 3; ++i) parts.push_back({"finger", finger, {side + 0.026 * (i - 1), 0.58, 0.04}});
  return parts;
}

void add_close_up_figure(World& world, SceneBuilder& builder, const CloseUpMaterials& m, std::size_t figure, dvec3 at,
                         double heading) {
  const Entity root = builder.add_group("figure " + std::to_string(figure), at, heading);
  world.add(root, CloseupSubject{.enabled = true, .priority = 1.0f, .lights = 0});
  for (const CloseUpPart& part : figure_parts(builder, m, figure))
    world.add(builder.add_instance(part.name, part.mesh, part.at, 0.0, part.scale), Parent{root, 1});
}

void add_yard(SceneBuilder& builder, const CloseUpMaterials& m) {
  builder.add_instance("floor", builder.add_mesh("floor", box_shape({26.0f, 0.2f, 26.0f}), m.floor), {0.0, -0.2, 0.0});
  builder.add_instance("wall", builder.add_mesh("wall", box_shape({26.0f, 4.0f, 0.3f}), m.wall), {0.0, 0.0, -4.5});
  const std::uint32_t post = builder.add_mesh("post", box_shape({0.14f, 3.0f, 0.14f}), m.wood);
  for (int i = 0; i < 5; ++i) builder.add_instance("post " + std::to_string(i), post, {-6.0 + 3.0 * i, 0.0, -3.2});
  const std::uint32_t bench = builder.add_mesh("bench", box_shape({1.6f, 0.42f, 0.4f}), m.wood);
  builder.add_instance("bench", bench, {1.4, 0.0, -2.4}, 0.2);
}

void add_close_up_lights(SceneBuilder& builder) {
  for (int i = 0; i < kCloseupLamps; ++i) {
    const double turn = 6.283185307179586 * i / kCloseupLamps;
    const bool spot = i % 2 == 1;
    Light light;
    light.kind = spot ? LightKind::spot : LightKind::point;
    light.color = spot ? vec3(0.65f, 0.75f, 1.0f) : vec3(1.0f, 0.76f, 0.5f);
    light.intensity = spot ? 160.0f : 60.0f;
    light.range_m = 14.0f;
    light.inner_angle = 0.7f;
    light.outer_angle = 0.9f;
    light.width_m = spot ? 0.12f : 0.2f;
    const dvec3 at(5.2 * glm::sin(turn), 3.2 + 0.15 * i, 5.2 * glm::cos(turn) * 0.75);
    builder.add_light("lamp " + std::to_string(i), light, at, dvec3(0.0, 0.6, 0.0) - at, true);
  }
  Light moon;
  moon.kind = LightKind::directional;
  moon.color = vec3(0.55f, 0.65f, 1.0f);
  moon.intensity = 1.2f;
  moon.apparent_angle = 0.03f;
  builder.add_light("moon", moon, dvec3(0.0, 10.0, 0.0), dvec3(-0.4, -0.75, -0.45), true);
}

}  // namespace

void build_closeups_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const CloseUpMaterials materials = add_close_up_materials(builder);
  add_yard(builder, materials);
  for (int i = 0; i < kCloseupFigures; ++i)
    add_close_up_figure(world, builder, materials, static_cast<std::size_t>(i),
                        {-2.7 + 1.8 * (i % 4), 0.0, i < 4 ? 0.6 : -1.3 + 0.3 * (i % 2)}, 0.7 * i);
  add_close_up_lights(builder);
  builder.add_camera("main", {0.6, 2.3, 5.6}, {0.0, 0.7, -0.4}, 0.75f);
  builder.add_camera("face", {-0.5, 1.55, 2.5}, {-0.9, 1.3, 0.6}, 0.6f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.10f, 0.15f, 0.32f);
  environment.sky_horizon = vec3(0.42f, 0.34f, 0.40f);
  environment.sky_ground = vec3(0.08f, 0.07f, 0.07f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 3.6f;
  info.name = "closeups";
}

void keep_closeup_figures(World& world, int count) {
  std::vector<Entity> figures;
  world.view<const CloseupSubject>().each([&](Entity entity, const CloseupSubject&) { figures.push_back(entity); });
  std::sort(figures.begin(), figures.end(), [](Entity a, Entity b) { return a.index < b.index; });
  for (std::size_t i = 0; i < figures.size(); ++i)
    world.get<CloseupSubject>(figures[i]).enabled = i < static_cast<std::size_t>(count);
}

}  // namespace gloam
