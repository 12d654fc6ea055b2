// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/dusk/parts.h"

namespace gloam {
namespace {

constexpr double kFacesEast = 0.5 * kPi, kFacesWest = -0.5 * kPi, kFacesNorth = kPi, kFacesSouth = 0.0;
constexpr vec3 kSlate(0.045f, 0.042f, 0.050f), kTiles(0.15f, 0.052f, 0.035f), kBrick(0.20f, 0.09f, 0.065f);

enum class Roof { along, gable };

/// Walls and roof of one house.
struct House {
  Facade facade;
  Roof roof = Roof::along;
  float roof_m = 2.6f;
  vec3 roof_color = kSlate;
  int dormers = 0;
};

/// A dormer whose window faces +Z, with its foot at the origin.
void add_dormer(Model& roof, Model& panes, vec3 foot, vec3 color) {
  roof.box(vec3(0.20f, 0.17f, 0.14f), foot + vec3(-0.55f, 0.0f, -1.6f), foot + vec3(0.55f, 1.05f, 0.0f));
  const mat4 turn =
      glm::rotate(glm::translate(mat4(1.0f), foot + vec3(0.0f, 1.05f, -0.75f)), 0.5f * kPi, vec3(0, 1, 0));
  roof.add(roof_shape({1.9f, 1.3f}, 0.55f), color, turn);
  panes.box(vec3(1.0f), foot + vec3(-0.32f, 0.2f, 0.0f), foot + vec3(0.32f, 0.92f, 0.015f));
}

/// In the space of the facade: x along it, y up from its foot, z out of the wall.
void add_roof(Dusk& dusk, const House& house, std::uint32_t lit) {
  const Facade& f = house.facade;
  Model roof, panes;
  const float eaves = f.height_m - 0.02f;
  if (house.roof == Roof::along) {
    roof.add(roof_shape({f.width_m + 0.02f, f.depth_m + 0.7f}, house.roof_m), house.roof_color,
             vec3(0.0f, eaves, -0.5f * f.depth_m));
    for (int i = 0; i < house.dormers; ++i) {
      const float x = f.width_m * ((static_cast<float>(i) + 0.5f) / static_cast<float>(house.dormers) - 0.5f);
      add_dormer(roof, panes, {x, eaves + 0.22f * house.roof_m, -0.42f}, house.roof_color);
    }
  } else {
    // The gable stands on the wall; its edge is stepped.
    const mat4 turn = glm::rotate(glm::translate(mat4(1.0f), vec3(0.0f, eaves, -0.5f * f.depth_m - 0.12f)), 0.5f * kPi,
                                  vec3(0, 1, 0));
    roof.add(roof_shape({f.depth_m, f.width_m + 0.3f}, house.roof_m), house.roof_color, turn);
    constexpr int kSteps = 5;
    for (int i = 0; i < kSteps; ++i) {
      const float half = 0.5f * f.width_m * (1.0f - static_cast<float>(i) / kSteps);
      const float y = house.roof_m * static_cast<float>(i) / kSteps;
      roof.box(kBrick * 1.15f, {-half, eaves + y, -0.3f}, {half, eaves + y + house.roof_m / kSteps + 0.12f, 0.0f});
    }
    panes.box(vec3(1.0f), {-0.35f, eaves + 0.45f, 0.0f}, {0.35f, eaves + 1.5f, 0.015f});
  }
  for (const float side : {-0.32f, 0.36f}) {
    const float x = side * f.width_m, top = eaves + house.roof_m + 0.7f;
    roof.box(kBrick, {x - 0.3f, eaves, -0.5f * f.depth_m - 0.9f}, {x + 0.3f, top, -0.5f * f.depth_m - 0.35f});
    for (const float pot : {-0.14f, 0.14f})
      roof.box(kTiles, {x + pot - 0.07f, top, -0.5f * f.depth_m - 0.7f},
               {x + pot + 0.07f, top + 0.28f, -0.5f * f.depth_m - 0.56f});
  }
  const Entity entity = add_dusk_model(dusk, "roof " + f.name, roof, dusk.materials.matt, f.foot, f.heading);
  dusk.world().get<MeshInstance>(entity).casts_shadows = false;
  if (!panes.shape().positions.empty()) {
    const Entity windows = add_dusk_model(dusk, "roof windows " + f.name, panes, lit, f.foot, f.heading);
    dusk.world().get<MeshInstance>(windows).casts_shadows = false;
  }
}

Facade row_facade(const char* name, double z0, double z1, float height_m, int columns, std::uint32_t wall) {
  Facade f;
  f.name = name;
  f.foot = {kDuskFacadeX, kDuskPavementY, 0.5 * (z0 + z1)};
  f.heading = kFacesEast;
  f.width_m = static_cast<float>(z0 - z1);
  f.height_m = height_m;
  f.columns = columns;
  f.wall = wall;
  return f;
}

void add_left_houses(Dusk& dusk, std::uint32_t lit) {
  House house{.facade = row_facade("left 1", kDuskSouthZ, 5.0, 7.2f, 5, 3), .roof_color = kTiles, .dormers = 2};
  house.facade.shops = 2, house.facade.first_shop = 3, house.facade.low_proxies = 2;
  add_facade(dusk.street, house.facade), add_roof(dusk, house, lit);
  house = {
      .facade = row_facade("left 2", 5.0, -1.6, 8.6f, 3, 0), .roof = Roof::gable, .roof_m = 3.4f, .roof_color = kSlate};
  house.facade.shops = 2, house.facade.first_shop = 5, house.facade.low_proxies = 2;
  add_facade(dusk.street, house.facade), add_roof(dusk, house, lit);
  house = {.facade = row_facade("left 3", -1.6, -10.6, 6.9f, 5, 1), .roof_color = kTiles, .dormers = 3};
  house.facade.shops = 2, house.facade.first_shop = 0, house.facade.low_proxies = 2;
  add_facade(dusk.street, house.facade), add_roof(dusk, house, lit);
  house = {.facade = row_facade("left 4", -10.6, -17.4, 9.4f, 3, 2),
           .roof = Roof::gable,
           .roof_m = 3.6f,
           .roof_color = kSlate};
  house.facade.shops = 2, house.facade.first_shop = 2;
  add_facade(dusk.street, house.facade), add_roof(dusk, house, lit);
  house = {.facade = row_facade("left 5", -17.4, kDuskNorthZ, 7.4f, 6, 3), .roof_color = kTiles, .dormers = 3};
  house.facade.shops = 3, house.facade.first_shop = 6;
  add_facade(dusk.street, house.facade), add_roof(dusk, house, lit);
}

/// A house with blank ground floor somewhere around the lawn or at an end of the street.
void add_far_house(Dusk& dusk, std::uint32_t lit, const char* name, dvec3 foot, double heading, vec2 size,
                   std::uint32_t wall, bool is_gabled, int proxies) {
  House house;
  Facade& f = house.facade;
  f.name = name, f.foot = foot, f.heading = heading, f.width_m = size.x, f.height_m = size.y, f.wall = wall;
  f.columns = std::max(2, static_cast<int>(size.x / 1.9f));
  f.low_proxies = proxies, f.high_proxies = 0;
  house.roof = is_gabled ? Roof::gable : Roof::along;
  house.roof_m = is_gabled ? 3.2f : 2.5f;
  house.roof_color = wall % 2 == 0 ? kSlate : kTiles;
  house.dormers = is_gabled ? 0 : static_cast<int>(size.x / 3.2f);
  add_facade(dusk.street, f), add_roof(dusk, house, lit);
}

/// The church tower behind the street's north end.
void add_tower(Dusk& dusk, std::uint32_t lit) {
  constexpr double kX = -3.6, kZ = kDuskNorthZ - 7.0;
  const vec3 stone(0.20f, 0.175f, 0.155f), dark(0.12f, 0.105f, 0.095f), copper(0.055f, 0.10f, 0.085f);
  Model tower, panes;
  tower.box(stone, {-1.9f, 0.0f, -1.9f}, {1.9f, 14.5f, 1.9f});
  for (const float y : {7.6f, 11.4f, 14.4f}) tower.box(dark, {-2.05f, y, -2.05f}, {2.05f, y + 0.22f, 2.05f});
  for (const float x : {-0.85f, 0.85f}) panes.box(vec3(1.0f), {x - 0.32f, 8.4f, 1.9f}, {x + 0.32f, 10.4f, 1.93f});
  const vec2 belfry[] = {{1.55f, 14.5f}, {1.5f, 16.4f}, {1.75f, 16.5f}, {1.75f, 16.7f}};
  const vec2 spire[] = {{1.85f, 16.7f}, {1.05f, 17.7f}, {0.72f, 18.4f}, {0.2f, 23.0f}, {0.05f, 25.2f}, {0.0f, 25.3f}};
  tower.add(turned_shape(belfry, 8), stone);
  tower.add(turned_shape(spire, 8), copper);
  tower.ball(vec3(0.45f, 0.32f, 0.10f), {0.0f, 25.4f, 0.0f}, vec3(0.2f), 10);
  add_dusk_model(dusk, "tower", tower, dusk.materials.matt, {kX, 0.0, kZ});
  add_dusk_model(dusk, "tower windows", panes, lit, {kX, 0.0, kZ});
  const vec2 dial[] = {{0.0f, 0.0f}, {1.15f, 0.0f}, {1.15f, 0.06f}, {0.0f, 0.06f}};
  const std::uint32_t face = dusk.builder().add_material({.name = "dial",
                                                          .base_color = vec4(0.3f, 0.3f, 0.28f, 1.0f),
                                                          .emissive = vec3(1.25f, 1.02f, 0.62f),
                                                          .metallic = 0.0f,
                                                          .roughness = 1.0f});
  const dvec3 middle(kX, 12.9, kZ + 1.9);
  const Entity disc =
      dusk.builder().add_instance("dial", dusk.builder().add_mesh("dial", turned_shape(dial, 32), face), middle);
  dusk.world().get<LocalTransform>(disc).rotation = dquat(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0);  // +Y to +Z
  Model hands;
  hands.box(vec3(0.02f), {-0.06f, -0.1f, 0.065f}, {0.06f, 0.9f, 0.09f});
  hands.box(vec3(0.02f), {-0.07f, -0.62f, 0.065f}, {0.07f, 0.1f, 0.09f});
  for (int i = 0; i < 12; ++i) {
    const float turn = kPi * static_cast<float>(i) / 6.0f, half = i % 3 == 0 ? 0.06f : 0.035f;
    const vec3 at(0.98f * std::cos(turn), 0.98f * std::sin(turn), 0.065f);
    hands.box(vec3(0.02f), at - vec3(half, half, 0.0f), at + vec3(half, half, 0.02f));
  }
  add_dusk_model(dusk, "dial hands", hands, dusk.materials.matt, middle);
}

}  // namespace

void add_dusk_houses(Dusk& dusk) {
  const std::uint32_t lit = dusk.builder().add_material({.name = "small window",
                                                         .base_color = vec4(0.03f, 0.03f, 0.03f, 1.0f),
                                                         .emissive = vec3(1.15f, 0.66f, 0.26f),
                                                         .metallic = 0.0f,
                                                         .roughness = 1.0f});
  add_left_houses(dusk, lit);
  const double north = kDuskNorthZ, y = kDuskPavementY;
  add_far_house(dusk, lit, "north 1", {-3.6, 0.0, north}, kFacesSouth, {5.4f, 6.2f}, 1, true, 1);
  add_far_house(dusk, lit, "north 3", {10.4, y, north}, kFacesSouth, {7.0f, 3.9f}, 0, false, 0);
  add_far_house(dusk, lit, "north 4", {16.6, y, north}, kFacesSouth, {6.4f, 5.4f}, 2, true, 0);
  add_far_house(dusk, lit, "south 1", {-2.2, 0.0, kDuskSouthZ}, kFacesNorth, {7.6f, 7.4f}, 2, false, 1);
  add_far_house(dusk, lit, "south 2", {5.2, 0.0, kDuskSouthZ}, kFacesNorth, {7.2f, 6.4f}, 1, true, 1);
  add_far_house(dusk, lit, "south 3", {13.4, y, kDuskSouthZ}, kFacesNorth, {9.2f, 5.6f}, 3, false, 0);
  add_far_house(dusk, lit, "east 1", {22.5, y, 8.2}, kFacesWest, {9.0f, 5.8f}, 0, false, 0);
  add_far_house(dusk, lit, "east 2", {22.5, y, -1.8}, kFacesWest, {9.0f, 6.6f}, 1, false, 0);
  add_far_house(dusk, lit, "east 3", {22.5, y, -20.6}, kFacesWest, {11.0f, 5.2f}, 3, false, 0);
  add_tower(dusk, lit);
  // A parapet closes the street; beyond it lie the valley and the sky.
  Model parapet;
  parapet.box(vec3(0.20f, 0.18f, 0.16f), {-1.2f, -0.4f, -0.2f}, {7.0f, 0.95f, 0.2f});
  parapet.box(vec3(0.26f, 0.24f, 0.21f), {-1.25f, 0.95f, -0.28f}, {7.05f, 1.07f, 0.28f});
  for (int i = 0; i < 4; ++i) {
    const float x = -0.9f + 2.53f * static_cast<float>(i);
    parapet.box(vec3(0.22f, 0.20f, 0.18f), {x - 0.25f, -0.4f, -0.3f}, {x + 0.25f, 1.25f, 0.3f});
    parapet.ball(vec3(0.24f, 0.22f, 0.2f), {x, 1.45f, 0.0f}, vec3(0.22f), 10);
  }
  add_dusk_model(dusk, "parapet", parapet, dusk.materials.matt, {0.0, 0.0, north - 0.1});
}

}  // namespace gloam
