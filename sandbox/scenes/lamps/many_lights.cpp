// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/many_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

// The garden is centred at the origin. Objects lie on Vogel's spiral, like the seeds of a sunflower. Metres.
constexpr double kGroundSize = 84.0;
constexpr int kGroundCells = 56;  // along one side
constexpr double kGardenRadius = 30.0;
constexpr double kGoldenAngle = 2.399963229728653;
constexpr int kLanterns = 640;
constexpr int kStones = 64;
constexpr int kLightsAStone = 4;
constexpr int kFireflies = 128;
constexpr int kPanes = 30;

constexpr std::array<vec3, 6> kGardenPalette = {vec3(1.0f, 0.62f, 0.26f),  vec3(1.0f, 0.36f, 0.16f),
                                                vec3(0.96f, 0.24f, 0.42f), vec3(0.62f, 0.30f, 1.0f),
                                                vec3(0.26f, 0.42f, 1.0f),  vec3(0.16f, 0.80f, 0.72f)};

struct GardenMaterials {
  std::uint32_t ground = 0;
  std::uint32_t stone = 0;
  std::uint32_t post = 0;
  std::array<std::uint32_t, 3> glass{};
};

/// One merged mesh per palette colour, so that a thousand small objects need only a few draws.
using ColoredShapes = std::array<Primitive, kGardenPalette.size()>;

/// Height of the ground: hills around a hollow.
double ground_height(double x, double z) {
  const double hills = 0.9 * std::sin(0.13 * x + 0.4) * std::cos(0.11 * z - 0.3) + 0.35 * std::sin(0.29 * x + 0.21 * z);
  return hills + 0.0046 * (x * x + z * z);
}

dvec3 on_ground(double x, double z, double above = 0.0) { return {x, ground_height(x, z) + above, z}; }

/// Place i of `count` on the spiral, turned by `turn` radians, `above` metres over the ground.
dvec3 spiral_place(int i, int count, double turn, double above) {
  const double radius = kGardenRadius * std::sqrt((i + 0.7) / count);
  const double angle = kGoldenAngle * i + turn;
  return on_ground(radius * std::cos(angle), radius * std::sin(angle), above);
}

/// A number in 0…1 that is spread evenly over i.
double spread(int i, double step) { return std::fmod(0.37 + i * step, 1.0); }

/// Palette index: changes with the direction from the origin and with the distance from it.
std::size_t color_at(const dvec3& place, int i) {
  const double turns = std::atan2(place.z, place.x) / (2.0 * static_cast<double>(kPi)) + 1.0;
  const double along = turns + std::hypot(place.x, place.z) * 0.022 + 0.12 * spread(i, 0.618033988);
  return static_cast<std::size_t>(along * kGardenPalette.size()) % kGardenPalette.size();
}

void append_lights(Primitive& into, const Primitive& part, const dvec3& offset, float scale = 1.0f) {
  const auto first = static_cast<std::uint32_t>(into.positions.size());
  for (const vec3& position : part.positions) {
    into.positions.push_back(position * scale + vec3(offset));
    into.bounds.grow(into.positions.back());
  }
  into.normals.insert(into.normals.end(), part.normals.begin(), part.normals.end());
  for (const std::uint32_t index : part.indices) into.indices.push_back(first + index);
}

GardenMaterials add_garden_materials(SceneBuilder& builder) {
  GardenMaterials materials;
  const auto add = [&](const char* name, vec4 color, float roughness) {
    Material material = {.name = name, .base_color = color, .metallic = 0.0f, .roughness = roughness};
    if (color.w < 1.0f) material.alpha_mode = AlphaMode::blend;
    material.double_sided = color.w < 1.0f;
    return builder.add_material(material);
  };
  materials.ground = add("moss", {0.10f, 0.13f, 0.075f, 1.0f}, 0.8f);
  materials.stone = add("stone", {0.46f, 0.44f, 0.42f, 1.0f}, 0.6f);
  materials.post = add("post", {0.09f, 0.08f, 0.075f, 1.0f}, 0.5f);
  materials.glass = {add("rose glass", {0.9f, 0.35f, 0.42f, 0.3f}, 0.12f),
                     add("green glass", {0.32f, 0.75f, 0.55f, 0.3f}, 0.12f),
                     add("blue glass", {0.35f, 0.5f, 0.95f, 0.3f}, 0.12f)};
  return materials;
}

void add_garden_ground(SceneBuilder& builder, const GardenMaterials& materials) {
  Primitive ground;
  constexpr double kCell = kGroundSize / kGroundCells;
  for (int row = 0; row <= kGroundCells; ++row) {
    for (int column = 0; column <= kGroundCells; ++column) {
      const double x = column * kCell - kGroundSize * 0.5;
      const double z = row * kCell - kGroundSize * 0.5;
      const double slope_x = (ground_height(x + 0.1, z) - ground_height(x - 0.1, z)) * 5.0;
      const double slope_z = (ground_height(x, z + 0.1) - ground_height(x, z - 0.1)) * 5.0;
      ground.positions.push_back(vec3(on_ground(x, z)));
      ground.normals.push_back(vec3(glm::normalize(dvec3(-slope_x, 1.0, -slope_z))));
      ground.bounds.grow(ground.positions.back());
    }
  }
  constexpr std::uint32_t kRow = kGroundCells + 1;
  for (std::uint32_t row = 0; row < kGroundCells; ++row) {
    for (std::uint32_t column = 0; column < kGroundCells; ++column) {
      const std::uint32_t at = row * kRow + column;
      for (const std::uint32_t corner : {at, at + kRow, at + 1, at + 1, at + kRow, at + kRow + 1})
        ground.indices.push_back(corner);
    }
  }
  builder.add_instance("ground", builder.add_mesh("ground", std::move(ground), materials.ground), dvec3(0.0));
}

void add_glowing(SceneBuilder& builder, const std::string& name, ColoredShapes& shapes, float luminance) {
  for (std::size_t i = 0; i < kGardenPalette.size(); ++i) {
    const Material glow = {.name = name + " " + std::to_string(i),
                           .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f),
                           .emissive = kGardenPalette[i] * luminance,
                           .metallic = 0.0f,
                           .roughness = 0.6f};
    const std::uint32_t mesh = builder.add_mesh(name, std::move(shapes[i]), builder.add_material(glow));
    builder.add_instance(name, mesh, dvec3(0.0));
  }
}

Light local_light(std::size_t color, float range_m) {
  Light light;
  light.kind = LightKind::point;
  light.color = kGardenPalette[color];
  light.intensity = 0.17f * range_m * range_m;
  light.range_m = range_m;
  return light;
}

std::string next_garden_name(int& count) { return "light " + std::to_string(count++); }

/// Lanterns on posts of different heights. Every fourth is a spot light that shines down.
void add_garden_lanterns(SceneBuilder& builder, const GardenMaterials& materials, int& count) {
  const vec2 outline[] = {{0.0f, -0.16f}, {0.11f, -0.03f}, {0.0f, 0.16f}};
  const Primitive lantern = turned_shape(outline, 5);
  const vec2 post_outline[] = {{0.022f, 0.0f}, {0.022f, 1.0f}};
  const Primitive post = turned_shape(post_outline, 4);
  ColoredShapes lanterns;
  Primitive posts;
  for (int i = 0; i < kLanterns; ++i) {
    const double height = 0.45 + 1.5 * spread(i, 0.754877666);
    const dvec3 place = spiral_place(i, kLanterns, 0.0, height);
    const std::size_t color = color_at(place, i);
    append_lights(lanterns[color], lantern, place);
    append_lights(posts, post, place + dvec3(0.0, -1.14, 0.0));
    Light light = local_light(color, static_cast<float>(1.6 + 2.6 * spread(i, 0.569840291)));
    if (i % 4 == 3) {
      light.kind = LightKind::spot;
      light.intensity *= 2.0f;
      light.outer_angle = 1.0f;
      light.inner_angle = 0.5f;
    }
    builder.add_light(next_garden_name(count), light, place - dvec3(0.0, 0.2, 0.0), {0.05, -1.0, 0.0}, false);
  }
  add_glowing(builder, "lantern", lanterns, 1.15f);
  builder.add_instance("posts", builder.add_mesh("posts", std::move(posts), materials.post), dvec3(0.0));
}

/// Standing stones, each with spot lights at its feet that shine up its sides.
void add_stones(SceneBuilder& builder, const GardenMaterials& materials, int& count) {
  for (int i = 0; i < kStones; ++i) {
    const dvec3 place = spiral_place(i, kStones, 1.1, -0.4);
    const double height = 1.8 + 2.9 * spread(i, 0.754877666);
    const double width = i % 9 == 4 ? 5.0 : 0.7 + 0.6 * spread(i, 0.569840291);  // some are walls
    const double depth = 0.45 + 0.3 * spread(i, 0.438579);
    const double heading = kGoldenAngle * i * 0.5;
    const vec3 size(static_cast<float>(width), static_cast<float>(height + 0.4), static_cast<float>(depth));
    builder.add_instance("stone", builder.add_mesh("stone", box_shape(size), materials.stone), place, heading);
    const dvec3 along(std::cos(heading), 0.0, -std::sin(heading));
    const dvec3 out(std::sin(heading), 0.0, std::cos(heading));
    for (int k = 0; k < kLightsAStone; ++k) {
      const double side = k % 2 == 0 ? 1.0 : -1.0;
      const dvec3 foot = place + along * (width * (k < 2 ? 0.28 : -0.28)) + out * (side * (depth * 0.5 + 0.35));
      Light light = local_light(color_at(place, i + 3 * k), static_cast<float>(2.6 + 2.4 * spread(i + k, 0.618033988)));
      light.kind = LightKind::spot;
      light.intensity *= 2.5f;
      light.outer_angle = 0.6f;
      light.inner_angle = 0.25f;
      light.width_m = 0.06f;
      builder.add_light(next_garden_name(count), light, on_ground(foot.x, foot.z, 0.12),
                        dvec3(0.0, 1.0, 0.0) - out * (0.2 * side), true);
    }
  }
}

void add_fireflies(SceneBuilder& builder, int& count) {
  const Primitive body = sphere_shape(0.03f, 5);
  ColoredShapes bodies;
  for (int i = 0; i < kFireflies; ++i) {
    const dvec3 place = spiral_place(i, kFireflies, 2.3, 0.5 + 2.8 * spread(i, 0.819172513));
    const std::size_t color = i % 3 == 0 ? 5 : 0;
    append_lights(bodies[color], body, place);
    builder.add_light(next_garden_name(count), local_light(color, static_cast<float>(1.0 + spread(i, 0.671043607))),
                      place, {0.0, -1.0, 0.0}, false);
  }
  add_glowing(builder, "firefly", bodies, 1.6f);
}

void add_panes(SceneBuilder& builder, const GardenMaterials& materials) {
  std::array<std::uint32_t, 3> meshes{};
  for (std::size_t i = 0; i < meshes.size(); ++i)
    meshes[i] = builder.add_mesh("pane", box_shape({2.0f, 2.9f, 0.04f}), materials.glass[i]);
  for (int i = 0; i < kPanes; ++i) {
    const dvec3 place = spiral_place(i, kPanes, 0.45, -0.3);
    builder.add_instance("pane", meshes[static_cast<std::size_t>(i) % meshes.size()], place, kGoldenAngle * i + 0.8);
  }
}

void add_moon(SceneBuilder& builder) {
  Light moon;
  moon.kind = LightKind::directional;
  moon.color = vec3(0.55f, 0.68f, 1.0f);
  moon.intensity = 0.045f;
  builder.add_light("moon", moon, {0.0, 20.0, 0.0}, {0.5, -0.8, -0.35}, true);
}

void add_garden_cameras(SceneBuilder& builder) {
  builder.add_camera("main", on_ground(-32.0, -17.0, 5.6), {4.0, 0.4, 2.0}, 0.85f);
  builder.add_camera("edge", on_ground(7.0, 32.0, 2.4), on_ground(-1.0, -6.0, 1.2), 0.9f);
  builder.add_camera("path", on_ground(-8.0, 13.0, 1.1), on_ground(7.0, -9.0, 1.2), 1.0f);
  builder.add_camera("stones", on_ground(7.5, -3.5, 1.4), on_ground(-8.0, -11.0, 1.8), 0.95f);
}

}  // namespace

void build_many_lights_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const GardenMaterials materials = add_garden_materials(builder);
  add_garden_ground(builder, materials);
  int count = 0;
  add_garden_lanterns(builder, materials, count);
  add_stones(builder, materials, count);
  add_fireflies(builder, count);
  add_panes(builder, materials);
  add_moon(builder);
  add_garden_cameras(builder);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.006f, 0.010f, 0.032f);
  environment.sky_horizon = vec3(0.030f, 0.026f, 0.055f);
  environment.sky_ground = vec3(0.004f, 0.005f, 0.006f);
  info.name = "many_lights";
}

void thin_out_lights(World& world, std::size_t count) {
  std::vector<Entity> lights;
  world.view<const Light>().each([&](Entity entity, const Light& light) {
    if (light.kind != LightKind::directional) lights.push_back(entity);
  });
  std::ranges::sort(lights, {}, &Entity::index);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    // Keep light i where i · count / size reaches the next whole number: this spreads the kept lights evenly.
    const bool stays = (i + 1) * count / lights.size() > i * count / lights.size();
    if (!stays) world.remove<Light>(lights[i]);
  }
}

}  // namespace gloam
