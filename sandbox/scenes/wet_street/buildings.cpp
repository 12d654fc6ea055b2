// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/wet_street/parts.h"

namespace gloam {
namespace {

constexpr double kToEast = 0.5 * kPi;   // heading of a facade on the left side, which faces +X
constexpr double kToWest = -0.5 * kPi;  // and on the right side, which faces −X
constexpr double kToNorth = kPi;        // faces −Z
constexpr double kToSouth = 0.0;        // faces +Z

/// A box between two corners, with the mesh standing on its lower face.
void add_block(Street& street, const std::string& name, std::uint32_t material, dvec3 min, dvec3 max) {
  street.builder.add_instance(name, street.builder.add_mesh(name, box_shape(vec3(max - min)), material),
                              {0.5 * (min.x + max.x), min.y, 0.5 * (min.z + max.z)});
}

/// A facade of the left (side −1) or right (side 1) row between z0 > z1.
Facade row_facade(const char* name, double side, double z0, double z1, float height_m) {
  Facade facade;
  facade.name = name;
  facade.foot = {side * kStreetFacadeX, kPavementY, 0.5 * (z0 + z1)};
  facade.heading = side < 0.0 ? kToEast : kToWest;
  facade.width_m = static_cast<float>(z0 - z1);
  facade.height_m = height_m;
  return facade;
}

void add_street_ground(Street& street) {
  const StreetMaterials& m = street.materials;
  add_block(street, "road", m.asphalt, {-kStreetKerbX, -0.3, kStreetNorthZ}, {kStreetKerbX, 0.0, kStreetSouthZ});
  add_block(street, "alley road", m.asphalt, {kStreetKerbX, -0.3, kAlleyNorthZ}, {kAlleyEndX, 0.0, kAlleySouthZ});
  // Pieces of pavement: side, z0, z1. The gatehouse and the alley interrupt it.
  struct Piece {
    double side, z0, z1;
  };
  constexpr Piece kPieces[] = {{-1.0, kStreetSouthZ, kGateSouthZ},
                               {-1.0, kGateNorthZ, kStreetNorthZ},
                               {1.0, kStreetSouthZ, kAlleySouthZ},
                               {1.0, kAlleyNorthZ, kGateSouthZ},
                               {1.0, kGateNorthZ, kStreetNorthZ}};
  for (const Piece& piece : kPieces) {
    const double kerb = piece.side * kStreetKerbX, inner = piece.side * (kStreetKerbX + 0.22);
    const double wall = piece.side * (kStreetFacadeX + 0.2);
    add_block(street, "kerb", m.kerb, {std::min(kerb, inner), -0.3, piece.z1},
              {std::max(kerb, inner), kPavementY, piece.z0});
    add_block(street, "pavement", m.pavement, {std::min(inner, wall), -0.3, piece.z1},
              {std::max(inner, wall), kPavementY, piece.z0});
  }
}

/// Patches of newer asphalt, manholes and a crossing, 2 mm above the road.
void add_road_marks(Street& street) {
  SceneBuilder& builder = street.builder;
  const auto mark = [&](const char* name, std::uint32_t material, double x, double z, vec2 size) {
    const std::uint32_t mesh = builder.add_mesh(name, box_shape({size.x, 0.012f, size.y}), material);
    street.world.get<MeshInstance>(builder.add_instance(name, mesh, {x, -0.01, z})).casts_shadows = false;
  };
  const std::uint32_t dark = builder.add_material(
      {.name = "new asphalt", .base_color = vec4(0.045f, 0.046f, 0.05f, 1.0f), .metallic = 0.0f, .roughness = 0.7f});
  const std::uint32_t white = builder.add_material(
      {.name = "road paint", .base_color = vec4(0.42f, 0.41f, 0.38f, 1.0f), .metallic = 0.0f, .roughness = 0.6f});
  mark("patch", dark, -2.1, 5.2, {1.4f, 2.6f});
  mark("patch", dark, 2.3, -0.6, {1.3f, 1.6f});
  mark("patch", dark, -0.2, -13.6, {2.2f, 2.0f});
  mark("patch", dark, 1.6, -33.0, {1.5f, 3.0f});
  for (int i = 0; i < 6; ++i) mark("stripe", white, -2.65 + 1.06 * i, -8.6, {0.5f, 2.2f});
  for (int i = 0; i < 6; ++i) mark("stripe", white, -2.65 + 1.06 * i, -42.0, {0.5f, 2.2f});
  const vec2 lid[] = {{0.0f, 0.0f}, {0.34f, 0.0f}, {0.34f, 0.013f}, {0.0f, 0.013f}};
  const std::uint32_t mesh = builder.add_mesh("manhole", turned_shape(lid, 28), street.materials.iron);
  for (const dvec3& at : {dvec3(0.3, -0.01, -0.7), dvec3(-0.7, -0.01, -5.9), dvec3(0.6, -0.01, -31.8)})
    street.world.get<MeshInstance>(builder.add_instance("manhole", mesh, at)).casts_shadows = false;
}

void add_left_row(Street& street) {
  Facade f = row_facade("left 1", -1.0, kStreetSouthZ, -3.0, 9.0f);
  f.shops = 3, f.columns = 6, f.wall = 0, f.first_shop = 0, f.low_proxies = 2, f.high_proxies = 2;
  add_facade(street, f);
  f = row_facade("left 2", -1.0, -3.0, -13.0, 7.0f);
  f.shops = 2, f.columns = 5, f.wall = 3, f.first_shop = 3, f.low_proxies = 2;
  add_facade(street, f);
  f = row_facade("left 3", -1.0, -13.0, kGateSouthZ, 10.0f);
  f.shops = 2, f.columns = 5, f.wall = 2, f.first_shop = 5, f.low_proxies = 2;
  add_facade(street, f);
  f = row_facade("left 4", -1.0, kGateNorthZ, -39.0, 8.0f);
  f.shops = 2, f.columns = 4, f.wall = 1, f.first_shop = 2;
  add_facade(street, f);
  f = row_facade("left 5", -1.0, -39.0, kStreetNorthZ, 9.5f);
  f.shops = 2, f.columns = 5, f.wall = 0, f.first_shop = 6;
  add_facade(street, f);
}

void add_right_row(Street& street) {
  Facade f = row_facade("right 1", 1.0, kStreetSouthZ, kTerraceFrontZ, 9.5f);
  f.shops = 3, f.columns = 7, f.wall = 1, f.first_shop = 1, f.low_proxies = 2, f.high_proxies = 2;
  add_facade(street, f);
  f = row_facade("arcade", 1.0, kTerraceFrontZ, kAlleySouthZ, static_cast<float>(kTerraceFloorY - kPavementY));
  f.shops = 3, f.wall = 2, f.first_shop = 4, f.ground_m = f.height_m, f.low_proxies = 2, f.high_proxies = 0;
  f.depth_m = static_cast<float>(kTerraceBackX - kStreetFacadeX);
  add_facade(street, f);
  f = row_facade("right 3", 1.0, kAlleyNorthZ, kGateSouthZ, 10.0f);
  f.columns = 1, f.wall = 3, f.high_proxies = 0;
  add_facade(street, f);
  f = row_facade("right 4", 1.0, kGateNorthZ, -39.0, 7.5f);
  f.shops = 2, f.columns = 5, f.wall = 3, f.first_shop = 3;
  add_facade(street, f);
  f = row_facade("right 5", 1.0, -39.0, kStreetNorthZ, 9.0f);
  f.shops = 2, f.columns = 5, f.wall = 2, f.first_shop = 0;
  add_facade(street, f);
}

/// The wall behind the street's south end, and the clock tower between two wings at its north end.
void add_street_ends(Street& street) {
  Facade f{.name = "south", .foot = {0.0, 0.0, kStreetSouthZ}, .heading = kToNorth, .width_m = 11.0f, .height_m = 9.0f};
  f.columns = 5, f.wall = 2;
  add_facade(street, f);
  for (const double side : {-1.0, 1.0}) {
    f = {.name = side < 0.0 ? "wing left" : "wing right",
         .foot = {side * 3.6, 0.0, kStreetNorthZ},
         .heading = kToSouth,
         .width_m = 3.8f,
         .height_m = 8.0f};
    f.columns = 2, f.wall = 1, f.high_proxies = 0;
    add_facade(street, f);
  }
  f = {.name = "clock tower",
       .foot = {0.0, 0.0, kStreetNorthZ + 0.2},
       .heading = kToSouth,
       .width_m = 3.4f,
       .height_m = 13.0f,
       .depth_m = 3.4f};
  f.columns = 2, f.wall = 3, f.high_proxies = 0, f.blank_m = 4.6f;
  add_facade(street, f);
  const vec2 dial[] = {{0.0f, 0.0f}, {1.15f, 0.0f}, {1.15f, 0.06f}, {0.0f, 0.06f}};
  const std::uint32_t lit = street.builder.add_material({.name = "dial",
                                                         .base_color = vec4(0.3f, 0.3f, 0.28f, 1.0f),
                                                         .emissive = vec3(1.7f, 1.55f, 1.1f),
                                                         .metallic = 0.0f,
                                                         .roughness = 1.0f});
  const dvec3 middle(0.0, 10.2, kStreetNorthZ + 0.2);
  const Entity face =
      street.builder.add_instance("facade dial", street.builder.add_mesh("dial", turned_shape(dial, 32), lit), middle);
  street.world.get<LocalTransform>(face).rotation = dquat(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0);  // +Y to +Z
  add_block(street, "facade hand", street.materials.wood, middle + dvec3(-0.06, -0.1, 0.06),
            middle + dvec3(0.06, 0.85, 0.1));
  add_block(street, "facade hand", street.materials.wood, middle + dvec3(-0.1, -0.06, 0.06),
            middle + dvec3(0.6, 0.06, 0.1));
}

/// Two piers and a house above the road, with facades to both sides. Its passage joins the two halves of the street.
void add_gatehouse(Street& street) {
  constexpr double kHeight = 9.5, kMiddleZ = 0.5 * (kGateSouthZ + kGateNorthZ);
  constexpr double kPierX = 0.5 * (kStreetKerbX + kStreetFacadeX);
  const auto depth = static_cast<float>(0.5 * (kGateSouthZ - kGateNorthZ));
  for (const double z : {kGateSouthZ, kGateNorthZ}) {
    const std::string end = z == kGateSouthZ ? " south" : " north";
    const double heading = z == kGateSouthZ ? kToSouth : kToNorth;
    Facade f{.name = "gate" + end,
             .foot = {0.0, kGateHeight, z},
             .heading = heading,
             .width_m = static_cast<float>(2.0 * kStreetFacadeX),
             .height_m = static_cast<float>(kHeight - kGateHeight),
             .depth_m = depth,
             .ground_m = 0.0f};
    f.columns = 5, f.wall = 0, f.low_proxies = 0, f.high_proxies = 1;
    add_facade(street, f);
    for (const double side : {-1.0, 1.0}) {
      f = {.name = "pier" + end + (side < 0.0 ? " left" : " right"),
           .foot = {side * kPierX, 0.0, z},
           .heading = heading,
           .width_m = static_cast<float>(kStreetFacadeX - kStreetKerbX),
           .height_m = static_cast<float>(kGateHeight),
           .depth_m = depth,
           .ground_m = static_cast<float>(kGateHeight)};
      f.wall = 0, f.high_proxies = 0;
      add_facade(street, f);
    }
  }
  const auto length = static_cast<float>(kGateSouthZ - kGateNorthZ);
  for (const double side : {-1.0, 1.0}) {
    const double x = side * kStreetKerbX;
    add_street_proxy(street, side < 0.0 ? "passage left" : "passage right",
                     {x - side * 0.02, 0.5 * kGateHeight, kMiddleZ}, {-side, 0.0, 0.0},
                     {length, static_cast<float>(kGateHeight)});
  }
  add_street_proxy(street, "passage ceiling", {0.0, kGateHeight - 0.02, kMiddleZ}, {0.0, -1.0, 0.0},
                   {static_cast<float>(2.0 * kStreetKerbX), length});
}

void add_alley(Street& street) {
  const double width = kAlleyEndX - kStreetFacadeX;
  Facade f{.name = "alley north",
           .foot = {kStreetFacadeX + 0.5 * width, 0.0, kAlleyNorthZ},
           .heading = kToSouth,
           .width_m = static_cast<float>(width),
           .height_m = 10.14f,
           .depth_m = static_cast<float>(kAlleyNorthZ - kGateNorthZ)};
  f.columns = 5, f.wall = 3;
  add_facade(street, f);
  f = {.name = "alley end",
       .foot = {kAlleyEndX, 0.0, 0.5 * (kAlleySouthZ + kAlleyNorthZ)},
       .heading = kToWest,
       .width_m = static_cast<float>(kAlleySouthZ - kAlleyNorthZ),
       .height_m = 9.0f};
  f.columns = 2, f.wall = 0, f.high_proxies = 0;
  add_facade(street, f);
  f = {.name = "alley south",
       .foot = {0.5 * (kStreetFacadeX + kTerraceBackX), 0.0, kAlleySouthZ},
       .heading = kToNorth,
       .width_m = static_cast<float>(kTerraceBackX - kStreetFacadeX),
       .height_m = static_cast<float>(kTerraceFloorY),
       .depth_m = 0.5f,
       .ground_m = static_cast<float>(kTerraceFloorY)};
  f.wall = 2, f.high_proxies = 0;
  add_facade(street, f);
  f = {.name = "alley south end",
       .foot = {0.5 * (kAlleyEndX + kTerraceBackX), 0.0, kAlleySouthZ},
       .heading = kToNorth,
       .width_m = static_cast<float>(kAlleyEndX - kTerraceBackX),
       .height_m = 9.0f};
  f.columns = 2, f.wall = 1, f.high_proxies = 0;
  add_facade(street, f);

  Primitive stairs;  // from the alley up to the terrace
  constexpr int kSteps = 20;
  for (int i = 0; i < kSteps; ++i) {
    const auto height = static_cast<float>(kTerraceFloorY) * static_cast<float>(i + 1) / kSteps;
    append_shape(stairs, box_shape({i + 1 < kSteps ? 0.28f : 1.3f, height, 1.3f}),
                 {6.4f + 0.28f * static_cast<float>(i) + (i + 1 < kSteps ? 0.14f : 0.65f), 0.0f, 0.0f});
  }
  street.builder.add_instance("stairs", street.builder.add_mesh("stairs", stairs, street.materials.roof),
                              {0.0, 0.0, kAlleySouthZ - 0.65});
}

void add_terrace(Street& street) {
  add_block(street, "terrace", street.materials.tiles,
            {kStreetFacadeX + 0.02, kTerraceFloorY - 0.04, kAlleySouthZ + 0.02},
            {kTerraceBackX + 0.1, kTerraceFloorY, kTerraceFrontZ});
  Facade f{.name = "terrace back",
           .foot = {kTerraceBackX, kTerraceFloorY, 0.5 * (kTerraceFrontZ + kAlleySouthZ)},
           .heading = kToWest,
           .width_m = static_cast<float>(kTerraceFrontZ - kAlleySouthZ),
           .height_m = 5.4f,
           .depth_m = 3.0f,
           .ground_m = 3.0f};
  f.shops = 3, f.columns = 5, f.wall = 1, f.first_shop = 2;
  add_facade(street, f);
  f = {.name = "terrace side",
       .foot = {0.5 * (kStreetFacadeX + kTerraceBackX), kTerraceFloorY, kTerraceFrontZ},
       .heading = kToNorth,
       .width_m = static_cast<float>(kTerraceBackX - kStreetFacadeX),
       .height_m = 6.04f,
       .depth_m = 0.5f,
       .ground_m = 2.8f};
  f.columns = 3, f.wall = 1, f.high_proxies = 0;
  add_facade(street, f);
}

/// A flat canopy over a shop of the right row, with a sign on its edge and a proxy below.
void add_canopy(Street& street) {
  const dvec3 min(kStreetFacadeX - 1.5, 3.34, -5.6), max(kStreetFacadeX, 3.42, -1.4);
  const StreetMaterials& m = street.materials;
  add_block(street, "canopy", m.cloth, min, max);
  add_block(street, "canopy edge", m.trim, {min.x - 0.04, 3.26, min.z}, {min.x, 3.5, max.z});
  const dvec3 sign(min.x - 0.08, 3.36, 0.5 * (min.z + max.z));
  add_block(street, "canopy board", m.wood, {sign.x + 0.01, sign.y - 0.06, sign.z - 1.06},
            {min.x, sign.y + 0.56, sign.z + 1.06});
  street.builder.add_instance(
      "canopy sign", street.builder.add_mesh("canopy sign", rectangle_shape({2.0f, 0.5f}), m.signs[2]), sign, kToWest);
  add_street_proxy(street, "canopy", {0.5 * (min.x + max.x), min.y - 0.02, 0.5 * (min.z + max.z)}, {0.0, -1.0, 0.0},
                   {static_cast<float>(max.x - min.x), static_cast<float>(max.z - min.z)});
}

}  // namespace

void add_street_buildings(Street& street) {
  add_street_ground(street);
  add_road_marks(street);
  add_left_row(street);
  add_right_row(street);
  add_street_ends(street);
  add_gatehouse(street);
  add_alley(street);
  add_terrace(street);
  add_canopy(street);
}

}  // namespace gloam
