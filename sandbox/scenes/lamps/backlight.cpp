// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/backlight.h"

#include <cmath>
#include <string>

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

/// A material that light passes through.
Material translucent(const char* name, const vec3& color, float extinction_m) {
  Material made{.name = name, .base_color = vec4(color, 1.0f), .metallic = 0.0f, .roughness = 0.6f};
  made.subsurface = true;
  made.extinction_m = extinction_m;
  return made;
}

/// Leaves around a stalk, two folded halves each, without thickness.
Primitive leaves_shape() {
  constexpr int kLeaves = 15;
  Primitive leaves;
  for (int i = 0; i < kLeaves; ++i) {
    const float angle = 2.4f * static_cast<float>(i), height = 0.18f + 0.045f * static_cast<float>(i);
    const float length = 0.3f - 0.01f * static_cast<float>(i);
    const vec3 out(std::cos(angle), 0.45f, std::sin(angle)), side(-std::sin(angle), 0.25f, std::cos(angle));
    const vec3 other(std::sin(angle), 0.25f, -std::cos(angle));
    const vec3 root(0.0f, height, 0.0f), tip = root + out * length, bend = root + out * (0.45f * length);
    for (const vec3& edge : {bend + side * (0.3f * length), bend + other * (0.3f * length)}) {
      const vec3 normal = glm::normalize(glm::cross(edge - root, tip - root));
      const auto first = static_cast<std::uint32_t>(leaves.positions.size());
      for (const vec3& corner : {root, edge, tip}) {
        leaves.positions.push_back(corner);
        leaves.normals.push_back(normal);
        leaves.bounds.grow(corner);
      }
      for (std::uint32_t corner = 0; corner < 3; ++corner) leaves.indices.push_back(first + corner);
    }
  }
  return leaves;
}

void add_screen(SceneBuilder& builder, std::uint32_t wood) {
  Material paper = translucent("paper", vec3(0.62f, 0.55f, 0.42f), 0.001f);
  paper.double_sided = true;
  const std::uint32_t sheet = builder.add_mesh("paper", rectangle_shape(vec2(1.0f, 1.1f)), builder.add_material(paper));
  builder.add_instance("paper", sheet, {-0.85, 0.05, 0.0});
  const std::uint32_t post = builder.add_mesh("post", box_shape({0.04f, 1.2f, 0.04f}), wood);
  for (const double x : {-1.37, -0.33}) builder.add_instance("post", post, {x, 0.0, 0.0});
  builder.add_instance("cross upright", builder.add_mesh("upright", box_shape({0.05f, 0.6f, 0.05f}), wood),
                       {-0.7, 0.2, -0.3});
  builder.add_instance("cross arm", builder.add_mesh("arm", box_shape({0.35f, 0.05f, 0.05f}), wood), {-0.7, 0.6, -0.3});
}

void add_solids(SceneBuilder& builder) {
  const std::uint32_t wax = builder.add_material(translucent("wax", vec3(0.7f, 0.45f, 0.22f), 0.03f));
  const vec2 candle[] = {{0.0f, 0.0f}, {0.05f, 0.0f}, {0.045f, 0.3f}, {0.03f, 0.32f}, {0.0f, 0.3f}};
  const std::uint32_t shape = builder.add_mesh("candle", turned_shape(candle, 32), wax);
  for (int i = 0; i < 3; ++i)
    builder.add_instance("candle " + std::to_string(i), shape, {0.68 + 0.16 * i, 0.0, 0.25 - 0.08 * i}, 0.0,
                         dvec3(1.0, 1.0 - 0.22 * i, 1.0));
  const std::uint32_t jade = builder.add_material(translucent("jade", vec3(0.25f, 0.55f, 0.35f), 0.012f));
  for (int i = 0; i < 3; ++i) {
    const float thickness = 0.006f * static_cast<float>(1 << i);
    builder.add_instance("slab " + std::to_string(i),
                         builder.add_mesh("slab", box_shape({0.16f, 0.24f, thickness}), jade),
                         {-0.1 + 0.2 * i, 0.0, 0.55});
  }
  const std::uint32_t ball = builder.add_mesh("ball", sphere_shape(0.13f, 48), jade);
  builder.add_instance("ball", ball, {1.25, 0.13, 0.2});
}

}  // namespace

void build_backlight_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const std::uint32_t ground = builder.add_material(
      {.name = "ground", .base_color = vec4(0.3f, 0.28f, 0.26f, 1.0f), .metallic = 0.0f, .roughness = 0.9f});
  const std::uint32_t wood = builder.add_material(
      {.name = "wood", .base_color = vec4(0.16f, 0.09f, 0.05f, 1.0f), .metallic = 0.0f, .roughness = 0.7f});
  builder.add_instance("ground", builder.add_mesh("ground", box_shape({12.0f, 0.2f, 12.0f}), ground), {0.0, -0.2, 0.0});
  add_screen(builder, wood);
  add_solids(builder);
  Material leaf = translucent("leaf", vec3(0.18f, 0.42f, 0.06f), 0.0005f);
  leaf.double_sided = true;
  builder.add_instance("leaves", builder.add_mesh("leaves", leaves_shape(), builder.add_material(leaf)),
                       {0.35, 0.0, 0.0});
  builder.add_instance("stalk", builder.add_mesh("stalk", box_shape({0.015f, 0.85f, 0.015f}), wood), {0.35, 0.0, 0.0});

  Light lamp;
  lamp.color = vec3(1.0f, 0.82f, 0.6f);
  lamp.intensity = 120.0f;
  lamp.range_m = 12.0f;
  lamp.width_m = 0.06f;
  builder.add_light("lamp", lamp, {0.0, 0.75, -1.3}, {0.0, -1.0, 0.0}, true);
  Light sun;
  sun.kind = LightKind::directional;
  sun.color = vec3(1.0f, 0.62f, 0.38f);
  sun.intensity = 25.0f;
  sun.apparent_angle = 0.0093f;
  builder.add_light("sun", sun, {0.0, 10.0, 0.0}, {-0.55, -0.28, 1.0}, true);
  builder.add_camera("main", {0.1, 0.8, 2.7}, {0.0, 0.45, 0.0}, 0.75f);
  builder.add_camera("leaves", {0.75, 0.75, 1.1}, {0.35, 0.55, 0.0}, 0.7f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.1f, 0.12f, 0.2f);
  environment.sky_horizon = vec3(0.5f, 0.35f, 0.25f);
  environment.sky_ground = vec3(0.08f, 0.07f, 0.06f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 4.6f;
  info.name = "backlight";
}

}  // namespace gloam
