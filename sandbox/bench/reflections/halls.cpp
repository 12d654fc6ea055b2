// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/reflections/halls.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/math/packing.h"
#include "engine/scene/components.h"
#include "modules/reflections/bake.h"
#include "modules/reflections/components.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

constexpr const char* kEmptied = "builtin:plain";
constexpr double kHalfWidth_m = 5.5;   // of the street
constexpr double kHouseDepth_m = 4.0;  // from a facade to the back of its house
constexpr double kSlot_m = 4.0;        // length of a house along the street
constexpr float kHeight_m = 8.0f;
constexpr double kBefore_m = 9.0;        // length of the first room before the first house
constexpr std::uint32_t kHallSide = 16;  // texels of a captured image
constexpr float kBrightest = 4000.0f;    // cd/m², so that a mirrored facade is well exposed
constexpr double kQuarter = 0.5 * std::numbers::pi;

/// Destroys all nodes of the scene.
void empty_world(Session& session) {
  std::vector<Entity> nodes;
  session.world.view<const LocalTransform>().each(
      [&](Entity entity, const LocalTransform&) { nodes.push_back(entity); });
  for (const Entity node : nodes) session.world.destroy(node);
  session.info = {};
}

/// Opaque images of one colour each.
ReflectionCaptures plain_captures(const World& world) {
  ReflectionCaptures captures;
  captures.content = 1;
  world.view<const IbrProxy>().each([&](Entity entity, const IbrProxy&) { captures.proxy_entities.push_back(entity); });
  std::ranges::sort(captures.proxy_entities, {}, &Entity::index);
  captures.proxies = {
      .side = kHallSide, .mips = 5, .count = static_cast<std::uint32_t>(captures.proxy_entities.size()), .texels = {}};
  for (std::uint32_t layer = 0; layer < captures.proxies.count; ++layer) {
    const auto share = [&](std::uint32_t steps) {
      return static_cast<float>(layer % steps + 1) / static_cast<float>(steps);
    };
    const float color[] = {kBrightest * share(5), kBrightest * share(7), kBrightest * share(3), 1.0f};
    for (std::size_t half = 0; half < captures.proxies.layer_halves(); ++half)
      captures.proxies.texels.push_back(float_to_half(color[half % 4]));
  }
  return captures;
}

void add_floor(SceneBuilder& builder) {
  Material wet{.name = "wet", .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f), .metallic = 0.0f, .roughness = 0.05f};
  wet.reflectivity = 1.0f;
  const std::uint32_t floor = builder.add_mesh("floor", box_shape({400.0f, 0.2f, 400.0f}), builder.add_material(wet));
  builder.add_instance("floor", floor, {0.0, -0.2, 0.0});
}

}  // namespace

void add_proxy_street(World& world, SceneInfo& info, std::uint32_t proxies, std::uint32_t rooms) {
  SceneBuilder builder(world, info);
  const auto add = [&](dvec3 position, double heading, double width_m) {
    const Entity entity = builder.add_group("", position, heading);
    world.add<IbrProxy>(entity, {.size_m = vec2(static_cast<float>(width_m), kHeight_m)});
  };
  const std::uint32_t houses = proxies / 2 - 1;
  const double length_m = kSlot_m * ((houses + 1) / 2), y = 0.5 * static_cast<double>(kHeight_m);
  for (std::uint32_t house = 0; house < houses; ++house) {
    const double side = house % 2 == 0 ? -1.0 : 1.0, z = -kSlot_m * (house / 2 + 0.5);
    add({side * kHalfWidth_m, y, z}, -side * kQuarter, kSlot_m);
    add({side * (kHalfWidth_m + kHouseDepth_m), y, z}, side * kQuarter, kSlot_m);
  }
  add({0.0, y, -length_m}, 0.0, 2.0 * kHalfWidth_m);
  add({0.0, y, -length_m - kHouseDepth_m}, 2.0 * kQuarter, 2.0 * kHalfWidth_m);
  for (std::uint32_t room = 0; room < rooms; ++room) {
    const double from = room == 0 ? kBefore_m : -length_m * room / rooms;
    const double to = -length_m * (room + 1) / rooms - (room + 1 == rooms ? 2.0 * kHouseDepth_m : 0.0);
    const Entity entity = builder.add_group("", {0.0, 5.9, 0.5 * (from + to)});
    world.add<IbrRoom>(entity, {.size_m = vec3(dvec3(24.0, 12.0, from - to))});
  }
}

Result<std::unique_ptr<Session>> open_proxy_street(BenchContext& context, std::uint32_t rooms) {
  auto session = context.open_builtin(kEmptied);
  if (!session) return session.error();
  World& world = (*session)->world;
  SceneInfo& info = (*session)->info;
  empty_world(**session);
  SceneBuilder builder(world, info);
  add_floor(builder);
  add_proxy_street(world, info, kStreetProxies, rooms);
  (*session)->camera = builder.add_camera("street", {0.3, 1.7, 4.0}, {0.0, 0.0, 1.3}, 0.9f);
  attach_captures(world, plain_captures(world));
  return session;
}

}  // namespace gloam
