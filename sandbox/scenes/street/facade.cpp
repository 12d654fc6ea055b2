// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/street/parts.h"

namespace gloam {
namespace {

// Local space of a facade: x along it, y up from its foot, z out of the wall. Metres.
constexpr float kLayer = 0.16f;  // depth of the front layer, in which windows are openings
constexpr float kPaneZ = -0.06f;
constexpr float kProxyZ = 0.01f;
constexpr float kStorey = 3.0f;  // least height of a floor above the ground floor
constexpr float kDoorHead = 2.35f;

/// The shapes of one facade by material.
struct FacadeShapes {
  std::map<std::uint32_t, Primitive> solid;
  std::map<std::uint32_t, Primitive> panes;

  void box(std::uint32_t material, vec3 min, vec3 max) {
    if (max.x - min.x < 1e-3f || max.y - min.y < 1e-3f) return;
    append_shape(solid[material], box_shape(max - min), {0.5f * (min.x + max.x), min.y, 0.5f * (min.z + max.z)});
  }
  void pane(std::uint32_t material, vec2 min, vec2 max, float z) {
    append_shape(panes[material], rectangle_shape(max - min), {0.5f * (min.x + max.x), min.y, z});
  }
};

/// A number in 0…n−1 for a window, always the same.
std::uint32_t choice(std::uint32_t seed, int floor, int column, std::uint32_t n) {
  std::uint32_t h = seed * 0x9e3779b1u + static_cast<std::uint32_t>(floor) * 0x85ebca6bu +
                    static_cast<std::uint32_t>(column) * 0xc2b2ae35u + 0x27d4eb2fu;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  return (h ^ h >> 13) % n;
}

/// Wall, window and frame between x0 and x1. The wall above and below the opening is not part of it.
void add_window(FacadeShapes& shapes, const StreetMaterials& m, std::uint32_t pane, vec2 min, vec2 max) {
  shapes.pane(pane, min, max, kPaneZ);
  const float middle = 0.5f * (min.x + max.x), bar = min.y + 0.64f * (max.y - min.y);
  shapes.box(m.trim, {middle - 0.03f, min.y, kPaneZ}, {middle + 0.03f, max.y, -0.02f});
  shapes.box(m.trim, {min.x, bar - 0.025f, kPaneZ}, {max.x, bar + 0.025f, -0.03f});
  shapes.box(m.trim, {min.x - 0.08f, min.y - 0.1f, -0.02f}, {max.x + 0.08f, min.y, 0.05f});
  shapes.box(m.trim, {min.x - 0.06f, max.y, -0.02f}, {max.x + 0.06f, max.y + 0.12f, 0.03f});
}

/// The floors above the ground floor, from y = from_m to the top.
void add_floors(FacadeShapes& shapes, const StreetMaterials& m, const Facade& f, float from_m, std::uint32_t seed) {
  const std::uint32_t wall = m.walls[f.wall];
  const float roof = f.height_m - 0.3f, top = roof - f.blank_m;
  const int floors = std::max(1, static_cast<int>((top - from_m) / kStorey));
  const float storey = (top - from_m) / static_cast<float>(floors);
  const float cell = f.width_m / static_cast<float>(f.columns);
  const float half = std::min(0.6f, 0.29f * cell);
  for (int floor = 0; floor < floors; ++floor) {
    const float y0 = from_m + storey * static_cast<float>(floor);
    const float sill = y0 + 0.27f * storey, head = y0 + 0.83f * storey;
    shapes.box(wall, {-0.5f * f.width_m, y0, -kLayer}, {0.5f * f.width_m, sill, 0.0f});
    shapes.box(wall, {-0.5f * f.width_m, head, -kLayer}, {0.5f * f.width_m, y0 + storey, 0.0f});
    float left = -0.5f * f.width_m;
    for (int column = 0; column < f.columns; ++column) {
      const float x = -0.5f * f.width_m + cell * (static_cast<float>(column) + 0.5f);
      shapes.box(wall, {left, sill, -kLayer}, {x - half, head, 0.0f});
      left = x + half;
      const std::uint32_t kind = choice(seed, floor, column, 9);
      add_window(shapes, m, kind < 5 ? m.windows[kind % 2] : (kind == 5 ? m.windows[2] : m.dark_glass),
                 {x - half, sill}, {x + half, head});
    }
    shapes.box(wall, {left, sill, -kLayer}, {0.5f * f.width_m, head, 0.0f});
    shapes.box(m.trim, {-0.5f * f.width_m, y0 - 0.06f, -0.02f}, {0.5f * f.width_m, y0 + 0.08f, 0.03f});
  }
  shapes.box(wall, {-0.5f * f.width_m, top, -kLayer}, {0.5f * f.width_m, roof, 0.0f});
  shapes.box(m.trim, {-0.5f * f.width_m, roof, -kLayer}, {0.5f * f.width_m, f.height_m, 0.1f});
}

/// One shop: pier, door, window above a low wall, and the sign over both.
void add_shop(FacadeShapes& shapes, const StreetMaterials& m, const Facade& f, float x0, float x1, std::size_t shop) {
  const std::uint32_t wall = m.walls[f.wall], pane = m.shops[shop % m.shops.size()];
  const float door0 = x0 + 0.3f, door1 = door0 + 0.95f, window0 = door1 + 0.2f, window1 = x1 - 0.3f;
  shapes.box(wall, {x0, 0.0f, -kLayer}, {door0, kDoorHead, 0.0f});
  shapes.box(wall, {door1, 0.0f, -kLayer}, {window0, kDoorHead, 0.0f});
  shapes.box(wall, {window1, 0.0f, -kLayer}, {x1, kDoorHead, 0.0f});
  shapes.box(m.wood, {window0, 0.0f, -kLayer}, {window1, 0.45f, -0.02f});

  shapes.box(m.wood, {door0, 0.0f, -kLayer}, {door1, 0.9f, kPaneZ + 0.02f});
  shapes.pane(pane, {door0, 0.9f}, {door1, kDoorHead}, kPaneZ);
  shapes.box(m.wood, {door0, 0.9f, kPaneZ}, {door0 + 0.12f, kDoorHead, kPaneZ + 0.03f});
  shapes.box(m.wood, {door1 - 0.12f, 0.9f, kPaneZ}, {door1, kDoorHead, kPaneZ + 0.03f});
  shapes.box(m.brass, {door1 - 0.1f, 0.95f, kPaneZ}, {door1 - 0.06f, 1.25f, 0.02f});

  shapes.pane(pane, {window0, 0.45f}, {window1, kDoorHead}, kPaneZ);
  const int bars = std::max(1, static_cast<int>((window1 - window0) / 1.1f));
  for (int i = 1; i <= bars; ++i) {
    const float x = window0 + (window1 - window0) * static_cast<float>(i) / static_cast<float>(bars + 1);
    shapes.box(m.wood, {x - 0.03f, 0.45f, kPaneZ}, {x + 0.03f, kDoorHead, -0.01f});
  }
  shapes.box(m.wood, {window0 - 0.05f, 0.4f, -0.04f}, {window1 + 0.05f, 0.48f, 0.04f});

  const float half = std::min(1.25f, 0.36f * (x1 - x0)), middle = 0.5f * (x0 + x1);
  shapes.box(m.wood, {middle - half - 0.06f, 2.52f, -0.02f},
             {middle + half + 0.06f, 2.52f + 0.5f * half + 0.12f, 0.04f});
  shapes.pane(m.signs[shop % m.signs.size()], {middle - half, 2.58f}, {middle + half, 2.58f + 0.5f * half}, 0.05f);
}

/// A blank ground floor with a door.
void add_plain_ground(FacadeShapes& shapes, const StreetMaterials& m, const Facade& f) {
  const std::uint32_t wall = m.walls[f.wall];
  const float half = 0.5f * f.width_m;
  if (f.width_m < 2.6f) {
    shapes.box(wall, {-half, 0.0f, -kLayer}, {half, f.ground_m, 0.0f});
    shapes.box(m.trim, {-half, 0.0f, -0.02f}, {half, 0.5f, 0.04f});
    return;
  }
  const float door = std::min(0.55f, 0.2f * f.width_m);
  shapes.box(wall, {-half, 0.0f, -kLayer}, {-door, 2.2f, 0.0f});
  shapes.box(wall, {door, 0.0f, -kLayer}, {half, 2.2f, 0.0f});
  shapes.box(wall, {-half, 2.2f, -kLayer}, {half, f.ground_m, 0.0f});
  shapes.box(m.wood, {-door, 0.0f, -kLayer}, {door, 1.75f, kPaneZ});
  shapes.pane(m.windows[0], {-door, 1.75f}, {door, 2.2f}, kPaneZ);
  shapes.box(m.trim, {-door - 0.12f, 2.2f, -0.02f}, {door + 0.12f, 2.34f, 0.05f});
  for (const float side : {-1.0f, 1.0f}) {
    const float a = side * door, b = side * half;
    shapes.box(m.trim, {std::min(a, b), 0.0f, -0.02f}, {std::max(a, b), 0.5f, 0.04f});
  }
}

dvec3 to_world(const Facade& f, dvec3 local) {
  const double c = std::cos(f.heading), s = std::sin(f.heading);
  return f.foot + dvec3(local.x * c + local.z * s, local.y, local.z * c - local.x * s);
}

void add_facade_proxies(Street& street, const Facade& f) {
  const dvec3 normal = to_world(f, {0.0, 0.0, 1.0}) - f.foot;
  const auto add_row = [&](const char* row, int count, float y0, float y1) {
    const float width = f.width_m / static_cast<float>(std::max(count, 1));
    for (int i = 0; i < count; ++i) {
      const double x = -0.5 * f.width_m + width * (i + 0.5);
      add_street_proxy(street, f.name + row + std::to_string(i), to_world(f, {x, 0.5 * (y0 + y1), kProxyZ}), normal,
                       {width, y1 - y0});
    }
  };
  const float middle = f.high_proxies == 0 ? f.height_m : f.ground_m;
  add_row(" low ", f.low_proxies, 0.0f, middle);
  add_row(" high ", f.high_proxies, middle, f.height_m);
}

}  // namespace

void add_facade(Street& street, const Facade& f) {
  const StreetMaterials& m = street.materials;
  FacadeShapes shapes;
  shapes.box(m.walls[f.wall], {-0.5f * f.width_m, 0.0f, -f.depth_m}, {0.5f * f.width_m, f.height_m - 0.05f, -kLayer});
  if (f.shops > 0) {
    const float bay = f.width_m / static_cast<float>(f.shops);
    for (int i = 0; i < f.shops; ++i) {
      const std::size_t shop = f.first_shop + static_cast<std::uint32_t>(i);
      const float x0 = -0.5f * f.width_m + bay * static_cast<float>(i);
      add_shop(shapes, m, f, x0, x0 + bay, shop);
      const vec3 color = m.shop_colors[shop % m.shop_colors.size()];
      const dvec3 lamp(x0 + 0.62 * bay, 2.2, 0.2);
      add_street_lamp(street, f.name + " shop " + std::to_string(i),
                      {.color = color, .candela = 9.0f, .range_m = 5.0f, .width_m = 0.0f, .outer_angle = 1.25f},
                      to_world(f, lamp), to_world(f, lamp + dvec3(0.0, -0.8, 0.6)) - to_world(f, lamp), false);
    }
    shapes.box(m.walls[f.wall], {-0.5f * f.width_m, kDoorHead, -kLayer}, {0.5f * f.width_m, f.ground_m, 0.0f});
  } else if (f.ground_m > 0.0f) {
    add_plain_ground(shapes, m, f);
  }
  if (f.height_m > f.ground_m + 1.0f)
    add_floors(shapes, m, f, f.ground_m, static_cast<std::uint32_t>(f.name.size()) * 7u + f.first_shop + f.wall);

  // Frames, sills and panes cast no shadows: they would be thinner than a texel of most maps.
  const auto add_shapes = [&](std::map<std::uint32_t, Primitive>& by_material) {
    for (auto& [material, shape] : by_material) {
      const std::uint32_t mesh = street.builder.add_mesh("facade " + f.name, std::move(shape), material);
      const Entity entity = street.builder.add_instance("facade " + f.name, mesh, f.foot, f.heading);
      street.world.get<MeshInstance>(entity).casts_shadows = material == m.walls[f.wall];
    }
  };
  add_shapes(shapes.solid);
  add_shapes(shapes.panes);
  add_facade_proxies(street, f);
}

Entity add_street_proxy(Street& street, const std::string& name, dvec3 center, dvec3 normal, vec2 size_m) {
  const Entity entity = street.builder.add_group("proxy " + name, center);
  street.world.get<LocalTransform>(entity).rotation = rotation_towards(-normal);
  IbrProxy proxy;
  proxy.size_m = size_m;
  street.world.add<IbrProxy>(entity, proxy);
  return entity;
}

void add_street_lamp(Street& street, const std::string& name, const StreetLamp& lamp, dvec3 position, dvec3 direction,
                     bool casts_shadows) {
  Light light;
  light.kind = lamp.outer_angle > 0.0f ? LightKind::spot : LightKind::point;
  light.color = lamp.color;
  light.intensity = lamp.candela;
  light.range_m = lamp.range_m;
  light.width_m = lamp.width_m;
  if (lamp.outer_angle > 0.0f) {
    light.inner_angle = 0.4f * lamp.outer_angle;
    light.outer_angle = lamp.outer_angle;
  }
  street.builder.add_light(name, light, position, direction, casts_shadows);
}

}  // namespace gloam
