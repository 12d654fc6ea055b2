// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/wet_street/parts.h"

namespace gloam {
namespace {

const dquat kYToX(std::sqrt(0.5), 0.0, 0.0, -std::sqrt(0.5));  // a rotation that takes +Y to +X

void add_street_figure(Street& street, dvec3 at, double heading) {
  const StreetMaterials& m = street.materials;
  const vec2 coat[] = {{0.0f, 0.45f}, {0.22f, 0.45f}, {0.17f, 0.85f}, {0.15f, 1.0f},
                       {0.2f, 1.32f}, {0.16f, 1.42f}, {0.05f, 1.5f},  {0.0f, 1.52f}};
  const vec2 canopy[] = {{0.0f, 2.04f}, {0.56f, 1.84f}, {0.58f, 1.86f}, {0.4f, 2.04f}, {0.2f, 2.13f}, {0.0f, 2.16f}};
  const std::uint32_t leg = street.builder.add_mesh("leg", box_shape({0.1f, 0.5f, 0.12f}), m.rubber);
  const auto add = [&](const char* name, const Primitive& shape, std::uint32_t material, dvec3 offset) {
    street.builder.add_instance(name, street.builder.add_mesh(name, shape, material), at + offset, heading);
  };
  for (const double side : {-0.09, 0.09}) {
    const dvec3 offset(side * std::cos(heading), 0.0, -side * std::sin(heading));
    street.builder.add_instance("leg", leg, at + offset, heading);
  }
  add("coat", turned_shape(coat, 24), m.cloth, {});
  add("head", sphere_shape(0.11f, 20), m.skin, {0.0, 1.6, 0.0});
  add("umbrella", turned_shape(canopy, 10), m.wood, {0.1, 0.0, 0.1});
  add("handle", box_shape({0.02f, 1.1f, 0.02f}), m.iron, {0.1, 1.0, 0.1});
}

void add_van(Street& street, double x, double rear_z) {
  const StreetMaterials& m = street.materials;
  const std::uint32_t red = street.builder.add_material({.name = "tail light",
                                                         .base_color = vec4(0.05f, 0.01f, 0.01f, 1.0f),
                                                         .emissive = vec3(3.0f, 0.12f, 0.08f),
                                                         .metallic = 0.0f,
                                                         .roughness = 1.0f});
  Primitive body = box_shape({1.8f, 1.65f, 3.0f});
  append_shape(body, box_shape({1.7f, 0.8f, 1.2f}), {0.0f, 0.0f, -2.05f});
  Primitive glass = box_shape({1.3f, 0.5f, 0.06f});
  append_shape(glass, box_shape({1.84f, 0.5f, 0.8f}), {0.0f, -0.05f, -2.55f});
  const dvec3 middle(x, 0.38, rear_z - 1.5);
  street.builder.add_instance("van", street.builder.add_mesh("van", body, m.paint), middle);
  street.builder.add_instance("van glass", street.builder.add_mesh("van glass", glass, m.dark_glass),
                              middle + dvec3(0.0, 0.95, 1.49));
  street.builder.add_instance("bumper", street.builder.add_mesh("bumper", box_shape({1.84f, 0.16f, 0.1f}), m.iron),
                              middle + dvec3(0.0, -0.02, 1.52));
  const std::uint32_t light = street.builder.add_mesh("tail light", box_shape({0.14f, 0.3f, 0.05f}), red);
  const vec2 tyre[] = {{0.0f, 0.0f}, {0.3f, 0.0f}, {0.34f, 0.04f}, {0.34f, 0.2f}, {0.3f, 0.22f}, {0.0f, 0.22f}};
  const std::uint32_t wheel = street.builder.add_mesh("wheel", turned_shape(tyre, 20), m.rubber);
  for (const double side : {-1.0, 1.0}) {
    street.builder.add_instance("tail light", light, middle + dvec3(side * 0.78, 0.35, 1.51));
    for (const double z : {0.9, -1.9}) {
      const Entity entity = street.builder.add_instance("wheel", wheel, {x + side * 0.76 - 0.11, 0.34, middle.z + z});
      street.world.get<LocalTransform>(entity).rotation = kYToX;
    }
  }
  add_street_proxy(street, "van", {x, 1.2, rear_z + 0.03}, {0.0, 0.0, 1.0}, {1.8f, 1.66f});
}

void add_small_things(Street& street) {
  const StreetMaterials& m = street.materials;
  SceneBuilder& builder = street.builder;
  const vec2 bollard[] = {{0.0f, 0.0f},   {0.1f, 0.0f},   {0.07f, 0.08f}, {0.06f, 0.72f},
                          {0.09f, 0.76f}, {0.09f, 0.84f}, {0.0f, 0.92f}};
  const std::uint32_t post = builder.add_mesh("bollard", turned_shape(bollard, 14), m.iron);
  for (int i = 0; i < 5; ++i) builder.add_instance("bollard", post, {3.75, kPavementY, -18.0 - 1.0 * i});
  for (int i = 0; i < 5; ++i) builder.add_instance("bollard", post, {-3.65, kPavementY, 5.2 - 1.6 * i});
  const std::uint32_t crate = builder.add_mesh("crate", box_shape({0.6f, 0.5f, 0.6f}), m.kerb);
  builder.add_instance("crate", crate, {-4.55, kPavementY, -6.9}, 0.3);
  builder.add_instance("crate", crate, {-4.95, kPavementY, -7.7}, 1.1);
  builder.add_instance("crate", crate, {-4.62, kPavementY + 0.5, -6.95}, 0.7, dvec3(0.8));
  builder.add_instance("crate", crate, {12.6, 0.0, -21.3}, 0.2);
  builder.add_instance("crate", crate, {13.3, 0.0, -21.4}, 0.6);
  builder.add_instance("crate", crate, {12.9, 0.5, -21.35}, 0.1);
  const vec2 pot[] = {{0.0f, 0.0f}, {0.2f, 0.0f}, {0.3f, 0.45f}, {0.26f, 0.45f}, {0.24f, 0.4f}, {0.0f, 0.4f}};
  const vec2 bush[] = {{0.0f, 0.38f}, {0.24f, 0.5f}, {0.36f, 0.8f}, {0.3f, 1.1f}, {0.12f, 1.35f}, {0.0f, 1.4f}};
  const std::uint32_t leaves = builder.add_material(
      {.name = "leaves", .base_color = vec4(0.05f, 0.10f, 0.05f, 1.0f), .metallic = 0.0f, .roughness = 1.0f});
  const std::uint32_t pots = builder.add_mesh("pot", turned_shape(pot, 18), m.walls[0]);
  const std::uint32_t bushes = builder.add_mesh("bush", turned_shape(bush, 9), leaves);
  for (const dvec3& at :
       {dvec3(12.4, kTerraceFloorY, -9.9), dvec3(12.4, kTerraceFloorY, -14.1), dvec3(6.2, kTerraceFloorY, -17.3),
        dvec3(12.3, kTerraceFloorY, -7.2), dvec3(-4.9, kPavementY, 1.2), dvec3(4.9, kPavementY, -6.2)}) {
    builder.add_instance("pot", pots, at);
    builder.add_instance("bush", bushes, at);
  }
  const vec2 table[] = {{0.0f, 0.0f},  {0.22f, 0.0f}, {0.03f, 0.04f}, {0.03f, 0.7f},
                        {0.4f, 0.71f}, {0.4f, 0.74f}, {0.0f, 0.74f}};
  const std::uint32_t tables = builder.add_mesh("table", turned_shape(table, 20), m.trim);
  const std::uint32_t stool = builder.add_mesh("stool", box_shape({0.36f, 0.44f, 0.36f}), m.wood);
  for (const dvec3& at : {dvec3(10.7, kTerraceFloorY, -12.2), dvec3(8.0, kTerraceFloorY, -14.8)}) {
    builder.add_instance("table", tables, at);
    builder.add_instance("stool", stool, at + dvec3(0.7, 0.0, 0.1), 0.2);
    builder.add_instance("stool", stool, at + dvec3(-0.5, 0.0, 0.5), 0.8);
  }
}

/// A railing along the local x axis from its start, at `heading`.
void add_railing(Street& street, dvec3 start, double heading, float length_m) {
  Primitive bars;
  for (const float y : {0.12f, 1.0f})
    append_shape(bars, box_shape({length_m, 0.04f, 0.04f}), {0.5f * length_m, y, 0.0f});
  const int count = static_cast<int>(length_m / 0.16f);
  for (int i = 0; i <= count; ++i) {
    const bool is_post = i % 10 == 0 || i == count;
    const float x = length_m * static_cast<float>(i) / static_cast<float>(count);
    append_shape(bars, box_shape({is_post ? 0.06f : 0.016f, is_post ? 1.08f : 0.9f, is_post ? 0.06f : 0.016f}),
                 {x, is_post ? 0.0f : 0.13f, 0.0f});
  }
  street.builder.add_instance("railing", street.builder.add_mesh("railing", bars, street.materials.iron), start,
                              heading);
}

}  // namespace

void add_street_things(Street& street) {
  add_street_figure(street, {1.05, 0.0, -3.2}, 0.5);
  add_van(street, 2.0, -11.5);
  add_small_things(street);
  add_railing(street, {kStreetFacadeX + 0.1, kTerraceFloorY, kAlleySouthZ + 0.1}, -0.5 * kPi,
              static_cast<float>(kTerraceFrontZ - kAlleySouthZ - 0.2));
  add_railing(street, {kStreetFacadeX + 0.1, kTerraceFloorY, kAlleySouthZ + 0.1}, 0.0, 6.2f);
}

}  // namespace gloam
