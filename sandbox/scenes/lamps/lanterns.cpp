// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/lanterns.h"

#include <array>
#include <cmath>

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

// The way runs along −Z from z = 0; metres.
constexpr int kBays = 10;
constexpr double kBayLength = 3.2;
constexpr double kArcadeX = 3.6;  // of the column axes
constexpr double kWallX = 6.4;    // inner faces of the outer walls
constexpr double kColumnHeight = 3.0;
constexpr double kStepsZ = -(kBays * kBayLength) - 1.2;
constexpr int kTerraceSteps = 5;
constexpr double kStepRise = 0.18;
constexpr double kStepDepth = 0.5;
constexpr double kTerraceZ = kStepsZ - kTerraceSteps * kStepDepth;
constexpr double kTerraceY = kTerraceSteps * kStepRise;
constexpr double kTerraceDepth = 6.0;
constexpr double kGateZ = kTerraceZ - kTerraceDepth + 0.4;

constexpr std::array<vec3, 6> kLanternPalette = {vec3(1.0f, 0.55f, 0.18f),  vec3(1.0f, 0.30f, 0.12f),
                                                 vec3(0.95f, 0.22f, 0.45f), vec3(0.20f, 0.75f, 0.70f),
                                                 vec3(0.32f, 0.38f, 1.0f),  vec3(0.70f, 0.32f, 1.0f)};

struct LanternMaterials {
  std::uint32_t paving = 0;
  std::uint32_t stone = 0;
  std::uint32_t wall = 0;
  std::uint32_t bronze = 0;
};

/// One mesh per palette colour, which emits that colour.
using GlowMeshes = std::array<std::uint32_t, kLanternPalette.size()>;

LanternMaterials add_lantern_materials(SceneBuilder& builder) {
  return {
      .paving = builder.add_material(
          {.name = "wet paving", .base_color = vec4(0.10f, 0.10f, 0.11f, 1.0f), .metallic = 0.0f, .roughness = 0.2f}),
      .stone = builder.add_material(
          {.name = "stone", .base_color = vec4(0.46f, 0.42f, 0.37f, 1.0f), .metallic = 0.0f, .roughness = 0.72f}),
      .wall = builder.add_material(
          {.name = "plaster", .base_color = vec4(0.50f, 0.45f, 0.41f, 1.0f), .metallic = 0.0f, .roughness = 0.9f}),
      .bronze = builder.add_material(
          {.name = "bronze", .base_color = vec4(0.62f, 0.42f, 0.24f, 1.0f), .metallic = 1.0f, .roughness = 0.34f}),
  };
}

GlowMeshes add_glow_meshes(SceneBuilder& builder, const std::string& name, const Primitive& shape, float luminance) {
  GlowMeshes meshes{};
  for (std::size_t i = 0; i < kLanternPalette.size(); ++i) {
    const Material glow = {.name = name + " " + std::to_string(i),
                           .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f),
                           .emissive = kLanternPalette[i] * luminance,
                           .metallic = 0.0f,
                           .roughness = 0.6f};
    meshes[i] = builder.add_mesh(name, shape, builder.add_material(glow));
  }
  return meshes;
}

Light point_light(std::size_t color, float candela, float range_m, float width_m) {
  Light light;
  light.kind = LightKind::point;
  light.color = kLanternPalette[color];
  light.intensity = candela;
  light.range_m = range_m;
  light.width_m = width_m;
  return light;
}

Light spot_light(std::size_t color, float candela, float range_m, float half_angle) {
  Light light = point_light(color, candela, range_m, 0.08f);
  light.kind = LightKind::spot;
  light.inner_angle = half_angle * 0.5f;
  light.outer_angle = half_angle;
  return light;
}

/// Name of the next light; count: number of lights named so far.
std::string next_name(int& count) { return "light " + std::to_string(count++); }

void add_arcades(SceneBuilder& builder, const LanternMaterials& materials) {
  const vec2 column[] = {{0.0f, 0.0f},   {0.36f, 0.0f}, {0.36f, 0.16f}, {0.29f, 0.26f}, {0.25f, 0.34f},
                         {0.21f, 2.62f}, {0.26f, 2.7f}, {0.36f, 2.84f}, {0.36f, 3.0f},  {0.0f, 3.0f}};
  const ArchSize arch = {
      .width_m = static_cast<float>(kBayLength), .height_m = 2.2f, .radius_m = 1.22f, .depth_m = 0.56f};
  const std::uint32_t column_mesh = builder.add_mesh("column", turned_shape(column, 24), materials.stone);
  const std::uint32_t arch_mesh = builder.add_mesh("arch", arch_shape(arch, 20), materials.wall);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i <= kBays; ++i)
      builder.add_instance("column", column_mesh, {side * kArcadeX, 0.0, -i * kBayLength});
    for (int i = 0; i < kBays; ++i)
      builder.add_instance("arch", arch_mesh, {side * kArcadeX, kColumnHeight, -(i + 0.5) * kBayLength},
                           0.5 * static_cast<double>(kPi));
  }
}

void add_grounds(SceneBuilder& builder, const LanternMaterials& materials) {
  const std::uint32_t ground = builder.add_mesh("paving", box_shape({60.0f, 0.2f, 70.0f}), materials.paving);
  builder.add_instance("paving", ground, {0.0, -0.2, -18.0});
  const std::uint32_t wall = builder.add_mesh("wall", box_shape({0.4f, 5.2f, 46.0f}), materials.wall);
  for (const double side : {-1.0, 1.0}) builder.add_instance("wall", wall, {side * (kWallX + 0.2), 0.0, -21.0});

  const auto width = static_cast<float>(2.0 * kWallX);
  for (int i = 0; i < kTerraceSteps; ++i) {
    const auto depth = static_cast<float>(kTerraceDepth + (kTerraceSteps - i) * kStepDepth);
    const std::uint32_t step =
        builder.add_mesh("step", box_shape({width, static_cast<float>(kStepRise), depth}), materials.stone);
    const double front = kStepsZ - i * kStepDepth;
    builder.add_instance("step", step, {0.0, i * kStepRise, front - depth * 0.5});
  }
  const ArchSize gate = {.width_m = width, .height_m = 3.6f, .radius_m = 2.2f, .depth_m = 0.5f};
  builder.add_instance("gate", builder.add_mesh("gate", arch_shape(gate, 40), materials.wall),
                       {0.0, kTerraceY + 1.6, kGateZ});
  const double pier_width = kWallX - 2.2;
  const std::uint32_t pier =
      builder.add_mesh("gate pier", box_shape({static_cast<float>(pier_width), 1.6f, 0.5f}), materials.wall);
  for (const double side : {-1.0, 1.0})
    builder.add_instance("gate pier", pier, {side * (2.2 + pier_width * 0.5), kTerraceY, kGateZ});
}

void add_urn(SceneBuilder& builder, const LanternMaterials& materials) {
  const vec2 urn[] = {{0.0f, 0.0f},   {0.62f, 0.0f}, {0.62f, 0.35f}, {0.3f, 0.5f},  {0.24f, 0.75f},
                      {0.55f, 1.15f}, {0.78f, 1.6f}, {0.72f, 1.95f}, {0.5f, 2.15f}, {0.62f, 2.3f},
                      {0.55f, 2.3f},  {0.42f, 2.1f}, {0.0f, 2.1f}};
  const std::uint32_t mesh = builder.add_mesh("urn", turned_shape(urn, 48), materials.bronze);
  builder.add_instance("urn", mesh, {0.0, kTerraceY, kTerraceZ - 2.6});
}

/// A lantern under every arch: 20 point lights.
void add_arch_lanterns(SceneBuilder& builder, int& count) {
  const vec2 lantern[] = {{0.0f, -0.2f}, {0.1f, -0.2f}, {0.16f, -0.1f}, {0.16f, 0.12f}, {0.07f, 0.22f}, {0.0f, 0.22f}};
  const GlowMeshes meshes = add_glow_meshes(builder, "lantern", turned_shape(lantern, 12), 2.2f);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < kBays; ++i) {
      const std::size_t color = i % 2 == 0 ? 0 : 1;
      const dvec3 position(side * kArcadeX, kColumnHeight + 0.45, -(i + 0.5) * kBayLength);
      builder.add_instance("lantern", meshes[color], position);
      // The light is just below the body: inside the body everything would be in its shadow.
      builder.add_light(next_name(count), point_light(color, 7.0f, 6.5f, 0.2f), position - dvec3(0.0, 0.26, 0.0),
                        {0, -1, 0}, true);
    }
  }
}

/// Four candles round the foot of every column: 88 point lights.
void add_candles(SceneBuilder& builder, int& count) {
  const vec2 candle[] = {{0.0f, 0.0f}, {0.035f, 0.0f}, {0.035f, 0.16f}, {0.012f, 0.2f}, {0.0f, 0.22f}};
  const GlowMeshes meshes = add_glow_meshes(builder, "candle", turned_shape(candle, 8), 1.6f);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i <= kBays; ++i) {
      for (int corner = 0; corner < 4; ++corner) {
        const double angle = (corner + 0.5) * 0.5 * static_cast<double>(kPi);
        const dvec3 position(side * kArcadeX + 0.52 * std::cos(angle), 0.0, -i * kBayLength + 0.52 * std::sin(angle));
        const auto color = static_cast<std::size_t>(i + corner) % kLanternPalette.size();
        builder.add_instance("candle", meshes[color], position);
        builder.add_light(next_name(count), point_light(color, 0.9f, 2.6f, 0.0f), position + dvec3(0.0, 0.3, 0.0),
                          {0, -1, 0}, false);
      }
    }
  }
}

/// Ten strings of nine paper globes from arcade to arcade: 90 point lights.
void add_lantern_garlands(SceneBuilder& builder, int& count) {
  constexpr int kGlobes = 9;
  const GlowMeshes meshes = add_glow_meshes(builder, "globe", sphere_shape(0.11f, 14), 1.8f);
  for (int string = 0; string < kBays; ++string) {
    for (int i = 0; i < kGlobes; ++i) {
      const double along = (i + 1.0) / (kGlobes + 1.0) * 2.0 - 1.0;
      const double height = 3.55 + 1.15 * along * along + 0.12 * ((string * 5 + i * 3) % 4);
      const dvec3 position(along * kArcadeX, height, -(string + 0.5) * kBayLength + 0.6 * along);
      const auto color = static_cast<std::size_t>(string * 2 + i) % kLanternPalette.size();
      builder.add_instance("globe", meshes[color], position);
      builder.add_light(next_name(count), point_light(color, 3.2f, 5.5f, 0.0f), position - dvec3(0.0, 0.16, 0.0),
                        {0, -1, 0}, false);
    }
  }
}

/// 17 wall washers at the foot of each side wall and 6 at the gate: 40 spot lights, cool against the warm lanterns.
void add_wall_washers(SceneBuilder& builder, int& count) {
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 17; ++i) {
      const std::size_t color = 3 + static_cast<std::size_t>(i / 2) % 3;
      const dvec3 position(side * (kWallX - 0.35), 0.12, -(i + 0.5) * kBayLength * 0.58);
      builder.add_light(next_name(count), spot_light(color, 9.0f, 6.0f, 0.62f), position, {side * 0.16, 1.0, 0.0},
                        true);
    }
    for (int i = 0; i < 3; ++i) {
      const std::size_t color = i == 1 ? 4 : 5;
      const dvec3 position(side * (2.8 + i * 1.35), kTerraceY + 0.12, kGateZ + 0.6);
      builder.add_light(next_name(count), spot_light(color, 9.0f, 6.0f, 0.62f), position, {0.0, 1.0, -0.16}, true);
    }
  }
}

/// A lamp at both ends of every step (10 point lights) and a ring of 8 spot lights on the urn.
void add_terrace_lights(SceneBuilder& builder, int& count) {
  const GlowMeshes meshes = add_glow_meshes(builder, "step lamp", sphere_shape(0.07f, 12), 1.8f);
  for (int i = 0; i < kTerraceSteps; ++i) {
    for (const double side : {-1.0, 1.0}) {
      const auto color = static_cast<std::size_t>(i) % 3;
      const dvec3 position(side * 2.9, (i + 1) * kStepRise + 0.07, kStepsZ - (i + 0.5) * kStepDepth);
      builder.add_instance("step lamp", meshes[color], position);
      builder.add_light(next_name(count), point_light(color, 1.4f, 3.2f, 0.0f), position + dvec3(0.0, 0.12, 0.0),
                        {0, -1, 0}, false);
    }
  }
  const dvec3 urn(0.0, kTerraceY + 1.3, kTerraceZ - 2.6);
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.25 * static_cast<double>(kPi);
    const dvec3 position(2.4 * std::cos(angle), kTerraceY + 3.4, urn.z + 2.4 * std::sin(angle));
    const auto color = static_cast<std::size_t>(i % 2 == 0 ? 0 : 4);
    builder.add_light(next_name(count), spot_light(color, 22.0f, 7.0f, 0.42f), position, urn - position, true);
  }
}

}  // namespace

void build_lanterns_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const LanternMaterials materials = add_lantern_materials(builder);
  add_grounds(builder, materials);
  add_arcades(builder, materials);
  add_urn(builder, materials);
  int count = 0;
  add_arch_lanterns(builder, count);
  add_candles(builder, count);
  add_lantern_garlands(builder, count);
  add_wall_washers(builder, count);
  add_terrace_lights(builder, count);
  builder.add_camera("main", {0.9, 1.65, 2.6}, {-0.35, 1.75, -14.0}, 0.95f);
  builder.add_camera("steps", {-2.3, 0.55, kStepsZ + 5.0}, {0.3, kTerraceY + 1.1, kTerraceZ - 2.6}, 0.85f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.010f, 0.018f, 0.045f);
  environment.sky_horizon = vec3(0.050f, 0.036f, 0.060f);
  environment.sky_ground = vec3(0.008f, 0.008f, 0.010f);
  info.name = "lanterns";
}

}  // namespace gloam
