// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/wet_street/scene.h"

#include <array>
#include <cmath>
#include <string>

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/wet_street/parts.h"

namespace gloam {
namespace {

constexpr double kFilm_m = 0.004;  // height of a puddle's surface above the ground
constexpr std::array<float, 5> kRoughness = {0.02f, 0.05f, 0.1f, 0.2f, 0.35f};

/// Its outline is an ellipse with bays.
struct Puddle {
  double x, z;
  float radius_x, radius_z;
  int roughness;  // index into kRoughness
};

constexpr Puddle kRoadPuddles[] = {
    {-1.3, 1.4, 1.6f, 1.2f, 0},   {1.2, -2.9, 1.3f, 1.5f, 1},   {-1.9, -3.7, 1.2f, 1.6f, 1},
    {0.5, -6.8, 1.5f, 1.2f, 3},   {1.7, 1.6, 0.9f, 1.1f, 2},    {-1.0, -10.2, 1.7f, 1.5f, 1},
    {2.0, -12.2, 1.1f, 2.4f, 2},  {-1.5, -16.4, 1.4f, 2.0f, 4}, {0.4, -20.6, 2.2f, 1.6f, 0},
    {0.0, -26.5, 1.8f, 1.5f, 2},  {0.1, -36.4, 2.5f, 4.4f, 0},  {-1.9, -31.0, 0.9f, 1.1f, 3},
    {1.8, -44.4, 1.1f, 2.0f, 2},  {-1.6, -45.4, 1.2f, 1.6f, 4}, {1.2, 5.6, 1.5f, 1.0f, 3},
    {8.6, -20.6, 1.4f, 0.95f, 1}, {11.4, -20.7, 1.2f, 0.8f, 0}, {14.2, -20.1, 0.9f, 1.0f, 3},
};
constexpr Puddle kPavementPuddles[] = {
    {-4.4, -6.6, 0.7f, 1.7f, 1}, {4.4, -2.9, 0.6f, 1.6f, 2}, {4.5, -14.0, 0.6f, 1.5f, 0}, {-4.4, 3.0, 0.6f, 1.2f, 3}};
constexpr Puddle kTerracePuddles[] = {
    {8.2, -9.9, 1.7f, 1.4f, 0}, {10.6, -13.2, 1.4f, 1.7f, 1}, {7.4, -15.2, 1.0f, 1.3f, 3}, {11.3, -8.0, 0.9f, 0.8f, 4}};

/// A flat star-shaped sheet that faces up. seed changes its bays.
Primitive puddle_shape(float radius_x, float radius_z, float seed) {
  constexpr int kCorners = 56;
  Primitive sheet;
  sheet.positions.emplace_back(0.0f);
  for (int i = 0; i < kCorners; ++i) {
    const float turn = 2.0f * kPi * static_cast<float>(i) / kCorners;
    const float reach = 0.84f + 0.10f * std::sin(2.0f * turn + seed) + 0.06f * std::sin(3.0f * turn + 2.3f * seed) +
                        0.03f * std::sin(5.0f * turn + 4.1f * seed);
    sheet.positions.emplace_back(reach * radius_x * std::cos(turn), 0.0f, -reach * radius_z * std::sin(turn));
  }
  sheet.normals.assign(sheet.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  for (std::uint32_t i = 0; i < kCorners; ++i)
    for (const std::uint32_t corner : {0u, 1u + i, 1u + (i + 1u) % kCorners}) sheet.indices.push_back(corner);
  for (const vec3& position : sheet.positions) sheet.bounds.grow(position);
  return sheet;
}

void add_puddles(Street& street) {
  std::array<std::uint32_t, kRoughness.size()> water{};
  for (std::size_t i = 0; i < water.size(); ++i) {
    Material material{.name = "puddle " + std::to_string(i),
                      .base_color = vec4(0.018f, 0.020f, 0.024f, 1.0f),
                      .metallic = 0.0f,
                      .roughness = kRoughness[i]};
    material.reflectivity = 1.0f - 0.05f * static_cast<float>(i);
    water[i] = street.builder.add_material(material);
  }
  int count = 0;
  const auto add = [&](const Puddle& puddle, double height) {
    const std::string name = "puddle " + std::to_string(count++);
    const Primitive sheet = puddle_shape(puddle.radius_x, puddle.radius_z, 1.7f * static_cast<float>(count));
    const std::uint32_t mesh = street.builder.add_mesh(name, sheet, water[static_cast<std::size_t>(puddle.roughness)]);
    const Entity entity = street.builder.add_instance(name, mesh, {puddle.x, height + kFilm_m, puddle.z});
    street.world.get<MeshInstance>(entity).casts_shadows = false;
  };
  for (const Puddle& puddle : kRoadPuddles) add(puddle, 0.0);
  for (const Puddle& puddle : kPavementPuddles) add(puddle, kPavementY);
  for (const Puddle& puddle : kTerracePuddles) add(puddle, kTerraceFloorY);
}

/// A room and its probe, each a box between two corners.
void add_street_room(Street& street, const std::string& name, dvec3 min, dvec3 max, dvec3 probe_min, dvec3 probe_max) {
  const Entity room = street.builder.add_group("room " + name, 0.5 * (min + max));
  street.world.add<IbrRoom>(room, {.size_m = vec3(max - min)});
  if (name == "terrace") {
    ReflectingHeights heights;
    heights.heights_m[0] = static_cast<float>(kTerraceFloorY);
    heights.count = 1;
    street.world.add<ReflectingHeights>(room, heights);
  }
  const Entity probe = street.builder.add_group("probe " + name, 0.5 * (probe_min + probe_max));
  street.world.add<CubeProbe>(probe, {.size_m = vec3(probe_max - probe_min), .resolution = 128, .global = false});
}

void add_rooms(Street& street) {
  constexpr double kRoomX = kStreetFacadeX + 0.3;
  // The passage of the gatehouse lies in both halves of the street; the alley's room reaches across the street, so
  // that the houses opposite its mouth belong to it. Probes reach a little behind the walls they show.
  add_street_room(street, "near", {-kRoomX, -0.1, -28.5}, {kRoomX, 11.0, 9.3}, {-6.0, -1.0, -24.5}, {6.0, 10.0, 9.5});
  add_street_room(street, "far", {-kRoomX, -0.1, -50.3}, {kRoomX, 16.0, -24.4}, {-6.0, -1.0, -50.5},
                  {6.0, 10.0, -28.5});
  add_street_room(street, "alley", {-kRoomX, -0.1, -22.3}, {16.3, 10.5, -17.7}, {5.5, -1.0, -22.5}, {16.5, 9.0, -17.5});
  add_street_room(street, "terrace", {-kRoomX, 3.4, -24.3}, {13.3, 11.0, -5.7}, {5.5, 3.0, -18.5}, {13.5, 9.5, -5.5});
  const Entity sky = street.builder.add_group("probe sky", {0.0, 18.0, -18.0});
  street.world.add<CubeProbe>(sky, {.size_m = vec3(0.0f), .resolution = 128, .global = true});
}

}  // namespace

void build_wet_street_scene(World& world, SceneInfo& info) {
  SceneBuilder builder(world, info);
  Street street{world, builder, add_street_materials(world, builder)};
  add_street_buildings(street);
  add_puddles(street);
  add_street_things(street);
  add_street_lights(street);
  add_rooms(street);
  builder.add_camera("street", {-0.5, 1.7, 5.6}, {0.0, 0.9, -9.0}, 0.95f);
  builder.add_camera("grazing", {0.3, 0.3, 3.4}, {-0.2, 0.55, -12.0}, 0.8f);
  builder.add_camera("down", {8.75, 3.0, -19.6}, {8.65, 0.0, -20.75}, 0.95f);
  builder.add_camera("terrace", {6.3, kTerraceFloorY + 1.65, -6.6}, {10.6, kTerraceFloorY + 0.4, -14.5}, 0.95f);
  builder.add_camera("shop", {-3.3, 1.05, -4.1}, {-4.9, 0.35, -7.3}, 0.95f);
  builder.add_camera("still", {0.4, 1.5, -30.2}, {0.0, 0.9, -48.0}, 1.0f);

  auto& environment = world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(0.016f, 0.030f, 0.078f);
  environment.sky_horizon = vec3(0.075f, 0.085f, 0.150f);
  environment.sky_ground = vec3(0.010f, 0.011f, 0.014f);
  environment.has_exposure = true;
  environment.exposure_ev100 = 0.0f;
  info.name = "wet_street";
}

}  // namespace gloam
