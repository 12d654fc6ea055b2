// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/shadow_grid.h"

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

// The pergola is centred at the origin. Metres.
constexpr double kSide = 64.0;
constexpr double kPillarStep = 8.0;
constexpr double kBeamStep = 4.0;
constexpr double kBeamHeight = 3.2;
constexpr double kLampHeight = 2.5;
constexpr double kLightsAPoint = 3.0;
constexpr int kPillars = 9;  // along a side
constexpr int kBeams = 17;
constexpr int kWalls = 40;
constexpr int kCrateCount = 90;
constexpr int kBoards = 8;
constexpr double kBoardTurn = 0.9;  // radians per second

constexpr std::array<vec3, 5> kGridPalette = {vec3(1.0f, 0.60f, 0.26f), vec3(1.0f, 0.38f, 0.16f),
                                              vec3(0.95f, 0.78f, 0.45f), vec3(0.30f, 0.52f, 1.0f),
                                              vec3(0.62f, 0.36f, 1.0f)};

/// Point i of Roberts' R2 sequence in a square of side `side`. The first n points are spread evenly for every n.
dvec3 spread_place(int i, double side, double start) {
  const auto along = [&](double step) { return (std::fmod(start + i * step, 1.0) - 0.5) * side; };
  return {along(0.75487766624669276), 0.0, along(0.56984029099805327)};
}

/// Moves a place along x until it is `distance` away from the nearest pillar, if it is closer in both x and z.
dvec3 beside_pillars(dvec3 place, double distance) {
  const auto off_axis = [&](double v) { return v - kPillarStep * std::round(v / kPillarStep); };
  const double x = off_axis(place.x), z = off_axis(place.z);
  if (std::abs(x) < distance && std::abs(z) < distance) place.x += x < 0.0 ? -distance : distance;
  return place;
}

struct GridMaterials {
  std::uint32_t ground, stone, wood, brick, iron;
};

GridMaterials add_grid_materials(SceneBuilder& builder) {
  const auto material = [&](const char* name, vec3 color, float roughness) {
    return builder.add_plain(name, color, roughness);
  };
  return {.ground = material("ground", vec3(0.34f, 0.32f, 0.30f), 0.8f),
          .stone = material("stone", vec3(0.55f, 0.51f, 0.45f), 0.85f),
          .wood = material("wood", vec3(0.30f, 0.19f, 0.11f), 0.7f),
          .brick = material("brick", vec3(0.44f, 0.20f, 0.14f), 0.9f),
          .iron = material("iron", vec3(0.08f, 0.08f, 0.09f), 0.5f)};
}

void add_pergola(SceneBuilder& builder, const GridMaterials& m) {
  const auto side = static_cast<float>(kSide);
  builder.add_instance("ground", builder.add_mesh("ground", box_shape({side * 2.0f, 0.2f, side * 2.0f}), m.ground),
                       {0.0, -0.2, 0.0});
  const vec2 outline[] = {{0.0f, 0.0f},   {0.36f, 0.0f}, {0.36f, 0.24f}, {0.24f, 0.34f},
                          {0.22f, 2.95f}, {0.34f, 3.0f}, {0.34f, 3.2f},  {0.0f, 3.2f}};
  const std::uint32_t pillar = builder.add_mesh("pillar", turned_shape(outline, 16), m.stone);
  for (int row = 0; row < kPillars; ++row)
    for (int column = 0; column < kPillars; ++column)
      builder.add_instance("pillar", pillar, {column * kPillarStep - kSide / 2, 0.0, row * kPillarStep - kSide / 2});
  const std::uint32_t beam = builder.add_mesh("beam", box_shape({side + 1.0f, 0.16f, 0.14f}), m.wood);
  for (int i = 0; i < kBeams; ++i) builder.add_instance("beam", beam, {0.0, kBeamHeight, i * kBeamStep - kSide / 2});
}

/// Low walls, crates, stacks of two crates, and posts with boards that turn.
void add_things(SceneBuilder& builder, const GridMaterials& m) {
  const std::uint32_t wall = builder.add_mesh("wall", box_shape({2.6f, 1.1f, 0.24f}), m.brick);
  for (int i = 0; i < kWalls; ++i)
    builder.add_instance("wall", wall, beside_pillars(spread_place(i, kSide - 6.0, 0.31), 1.8),
                         i % 2 == 0 ? 0.0 : 1.571);
  const std::uint32_t crate = builder.add_mesh("crate", box_shape({0.7f, 0.6f, 0.7f}), m.wood);
  for (int i = 0; i < kCrateCount; ++i) {
    const dvec3 place = beside_pillars(spread_place(i, kSide - 4.0, 0.77), 1.0);
    builder.add_instance("crate", crate, place, 0.7 * i);
    if (i % 3 == 0) builder.add_instance("crate", crate, place + dvec3(0.06, 0.6, -0.05), 0.7 * i + 0.4, dvec3(0.8));
  }
  const std::uint32_t post = builder.add_mesh("post", box_shape({0.08f, 2.3f, 0.08f}), m.iron);
  const std::uint32_t board = builder.add_mesh("board", box_shape({1.3f, 0.7f, 0.05f}), m.brick);
  for (int i = 0; i < kBoards; ++i) {
    const dvec3 place = beside_pillars(spread_place(i, kSide * 0.5, 0.13), 1.4);
    builder.add_instance("post", post, place);
    builder.add_instance("board " + std::to_string(i), board, place + dvec3(0.0, 1.3, 0.0));
  }
}

Light lamp(int i) {
  Light light;
  light.color = kGridPalette[static_cast<std::size_t>(i) % kGridPalette.size()];
  light.width_m = 0.12f;
  if (i % 2 == 0) return light;
  light.kind = LightKind::spot;
  light.inner_angle = 0.5f;
  light.outer_angle = 0.95f;
  return light;
}

/// Lamps under the beams: a point light below a lantern, or a spot light below a hood.
void add_lamps(SceneBuilder& builder, const GridMaterials& m) {
  const vec2 lantern[] = {{0.0f, 0.0f}, {0.12f, 0.03f}, {0.17f, 0.16f}, {0.12f, 0.3f}, {0.0f, 0.33f}};
  const vec2 hood[] = {{0.0f, 0.12f}, {0.26f, 0.12f}, {0.06f, 0.3f}, {0.0f, 0.32f}};
  const std::uint32_t rod = builder.add_mesh("rod", box_shape({0.02f, 0.5f, 0.02f}), m.iron);
  const std::uint32_t hood_mesh = builder.add_mesh("hood", turned_shape(hood, 12), m.iron);
  std::array<std::uint32_t, kGridPalette.size()> lanterns{};
  for (std::size_t i = 0; i < lanterns.size(); ++i) {
    const Material glow = {.name = "glow " + std::to_string(i),
                           .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f),
                           .emissive = kGridPalette[i] * 1.6f,
                           .metallic = 0.0f,
                           .roughness = 0.6f};
    lanterns[i] = builder.add_mesh("lantern", turned_shape(lantern, 12), builder.add_material(glow));
  }
  for (int i = 0; i < static_cast<int>(kShadowGridLights); ++i) {
    dvec3 place = spread_place(i, kSide, 0.5);
    place.z = kBeamStep * std::round(place.z / kBeamStep);
    place = beside_pillars(place, 0.9) + dvec3(0.0, kLampHeight, 0.0);
    const std::size_t color = static_cast<std::size_t>(i) % kGridPalette.size();
    builder.add_instance("lamp", i % 2 == 0 ? lanterns[color] : hood_mesh, place + dvec3(0.0, 0.06, 0.0));
    builder.add_instance("rod", rod, place + dvec3(0.0, 0.34, 0.0));
    builder.add_light("light " + std::to_string(i), lamp(i), place, {0.0, -1.0, 0.0}, true);
  }
}

}  // namespace

void build_shadow_grid_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  const GridMaterials materials = add_grid_materials(builder);
  add_pergola(builder, materials);
  add_things(builder, materials);
  add_lamps(builder, materials);
  arrange_shadow_grid_lights(world, kShadowGridLights, kLightsAPoint);
  builder.add_camera("main", {-14.2, 2.2, 14.3}, {0.5, 0.2, -2.0}, 0.85f);
  builder.add_camera("aisle", {-4.0, 1.7, 10.0}, {-3.4, 1.2, -8.0}, 0.95f);
  builder.add_camera("corner", {-10.0, 1.6, -6.0}, {8.0, 0.8, -14.0}, 0.95f);
  builder.add_camera("crates", {6.0, 1.1, -13.0}, {13.0, 0.4, 2.0}, 0.9f);
  builder.add_camera("over", {18.0, 9.0, 8.0}, {-2.0, 0.0, 0.0}, 0.9f);
  builder.add_camera("far", {4.0, 2.0, 24.0}, {-4.0, 1.2, 0.0}, 0.7f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.010f, 0.016f, 0.040f);
  environment.sky_horizon = vec3(0.030f, 0.028f, 0.052f);
  environment.sky_ground = vec3(0.006f, 0.007f, 0.009f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 1.0f;
  info.name = "shadow_grid";
}

double shadow_grid_range_m(std::size_t count, double lights_a_point) {
  // The sphere of a light's range cuts the ground in a disc. The discs of all lights together cover the square
  // `lights_a_point` times. A spot's cone covers only a part of its disc: about 0.6 if ranges are small against the
  // height, less if they are large. This is ignored here.
  const double disc = lights_a_point * kSide * kSide / static_cast<double>(std::max<std::size_t>(count, 1));
  return std::sqrt(disc / 3.14159265358979 + kLampHeight * kLampHeight);
}

void arrange_shadow_grid_lights(World& world, std::size_t count, double lights_a_point) {
  std::vector<Entity> lights;
  world.view<const Light>().each([&](Entity entity, const Light&) { lights.push_back(entity); });
  std::ranges::sort(lights, {}, &Entity::index);
  for (std::size_t i = count; i < lights.size(); ++i) {
    world.remove<Light>(lights[i]);
    if (world.has<LightBounds>(lights[i])) world.remove<LightBounds>(lights[i]);
  }
  const double range_m = shadow_grid_range_m(std::min(count, lights.size()), lights_a_point);
  for (std::size_t i = 0; i < std::min(count, lights.size()); ++i) {
    Light& light = world.get<Light>(lights[i]);
    light.range_m = static_cast<float>(range_m);
    // The sum of the lights that reach a point is the same for every `lights_a_point`.
    const double candela = (light.kind == LightKind::spot ? 36.0 : 24.0) * 3.0 / std::max(lights_a_point, 1.0);
    light.intensity = static_cast<float>(candela);
  }
}

void turn_shadow_grid_boards(World& world, double time_s) {
  for (int i = 0; i < kBoards; ++i) {
    const auto board = world.resource<SceneNames>().find("mesh", "board " + std::to_string(i));
    if (!board) continue;
    const double half = 0.5 * (kBoardTurn * time_s + 0.8 * i);
    world.get<LocalTransform>(*board).rotation = dquat(std::cos(half), 0.0, std::sin(half), 0.0);
  }
}

}  // namespace gloam
