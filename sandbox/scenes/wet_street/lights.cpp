// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "engine/scene/resources.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/scenes/wet_street/parts.h"

namespace gloam {
namespace {

constexpr vec3 kSodium(1.0f, 0.66f, 0.30f);
constexpr vec3 kWarm(1.0f, 0.78f, 0.50f);
constexpr vec3 kCool(0.62f, 0.78f, 1.0f);

/// Ten posts at the kerbs, each with an arm over the road and a hood above its bulb: spot lights, eight of which cast.
void add_street_lamps(Street& street) {
  SceneBuilder& builder = street.builder;
  const std::uint32_t iron = street.materials.iron;
  const vec2 shaft[] = {{0.0f, 0.0f},   {0.14f, 0.0f},  {0.14f, 0.5f},  {0.07f, 0.62f},
                        {0.045f, 4.3f}, {0.07f, 4.34f}, {0.07f, 4.46f}, {0.0f, 4.5f}};
  const vec2 hood[] = {{0.0f, 0.05f}, {0.08f, 0.05f}, {0.3f, -0.06f}, {0.31f, -0.04f}, {0.12f, 0.16f}, {0.0f, 0.2f}};
  const std::uint32_t post = builder.add_mesh("lamp post", turned_shape(shaft, 12), iron);
  const std::uint32_t arm = builder.add_mesh("lamp arm", box_shape({0.8f, 0.05f, 0.05f}), iron);
  const std::uint32_t cap = builder.add_mesh("lamp hood", turned_shape(hood, 18), iron);
  const std::uint32_t bulb =
      builder.add_mesh("bulb", sphere_shape(0.09f, 14), street.builder.add_glow("bulb", kSodium * 16.0f));
  struct Post {
    double side, z;
    bool casts;
  };
  constexpr Post kPosts[] = {{-1.0, 4.0, true},   {1.0, 0.6, true},   {-1.0, -8.4, true},   {1.0, -11.0, true},
                             {-1.0, -16.5, true}, {1.0, -22.6, true}, {-1.0, -31.5, false}, {1.0, -36.0, true},
                             {-1.0, -41.0, true}, {1.0, -46.0, false}};
  int count = 0;
  for (const Post& p : kPosts) {
    const double x = p.side * (kStreetKerbX + 0.3);
    const dvec3 lamp(x - p.side * 0.8, 4.2, p.z);
    builder.add_instance("lamp post", post, {x, kPavementY, p.z});
    const Entity above[] = {builder.add_instance("lamp arm", arm, {x - p.side * 0.4, 4.38, p.z}),
                            builder.add_instance("lamp hood", cap, lamp + dvec3(0.0, 0.06, 0.0))};
    for (const Entity part : above) street.world.get<MeshInstance>(part).casts_shadows = false;  // outside the cone
    builder.add_instance("bulb", bulb, lamp);
    add_street_lamp(street, "street lamp " + std::to_string(count++),
                    {.color = kSodium, .candela = 62.0f, .range_m = 11.0f, .width_m = 0.1f, .outer_angle = 1.32f}, lamp,
                    {-p.side * 0.1, -1.0, 0.0}, p.casts);
  }
}

/// A burning barrel, with its proxy.
void add_street_fire(Street& street, dvec3 at) {
  SceneBuilder& builder = street.builder;
  const vec2 barrel[] = {{0.0f, 0.0f},   {0.29f, 0.0f},  {0.29f, 0.28f}, {0.31f, 0.3f}, {0.29f, 0.32f}, {0.29f, 0.6f},
                         {0.31f, 0.62f}, {0.29f, 0.64f}, {0.29f, 0.9f},  {0.27f, 0.9f}, {0.26f, 0.7f},  {0.0f, 0.7f}};
  const vec2 flame[] = {{0.0f, 0.72f}, {0.2f, 0.78f},  {0.24f, 0.95f}, {0.17f, 1.15f},
                        {0.1f, 1.38f}, {0.03f, 1.58f}, {0.0f, 1.66f}};
  const vec2 tongue[] = {{0.0f, 0.0f}, {0.09f, 0.12f}, {0.06f, 0.3f}, {0.0f, 0.55f}};
  builder.add_instance("barrel", builder.add_mesh("barrel", turned_shape(barrel, 24), street.materials.iron), at);
  const auto add_flame = [&](const char* name, const Primitive& shape, vec3 luminance, dvec3 offset) {
    const std::uint32_t mesh = builder.add_mesh(name, shape, street.builder.add_glow(name, luminance));
    const Entity entity = builder.add_instance(name, mesh, at + offset);
    street.world.get<MeshInstance>(entity).casts_shadows = false;
  };
  add_flame("flame", turned_shape(flame, 12), vec3(4.2f, 1.55f, 0.2f), {});
  add_flame("flame left", turned_shape(tongue, 8), vec3(3.6f, 0.85f, 0.06f), {-0.17, 0.82, 0.05});
  add_flame("flame right", turned_shape(tongue, 8), vec3(3.6f, 0.85f, 0.06f), {0.16, 0.9, 0.04});
  add_street_lamp(street, "fire",
                  {.color = vec3(1.0f, 0.46f, 0.14f), .candela = 26.0f, .range_m = 8.0f, .width_m = 0.08f},
                  at + dvec3(0.0, 1.25, 0.0), {0.0, -1.0, 0.0}, true);
  const Entity proxy = add_street_proxy(street, "fire", at + dvec3(0.0, 1.2, 0.0), {0.0, 0.0, 1.0}, {0.7f, 1.0f});
  IbrProxy& fire = street.world.get<IbrProxy>(proxy);
  fire.kind = IbrProxyKind::fire;
  fire.lights = street.world.resource<SceneStrings>().intern("fire");
}

/// A small lantern at a wall, and its light before it.
struct WallLamp {
  const char* name;
  dvec3 at;       ///< on the wall
  dvec3 outward;  ///< unit length
  vec3 color;
  float candela;
  bool casts;
};

void add_wall_lamps(Street& street) {
  const vec2 lantern[] = {{0.0f, -0.14f}, {0.05f, -0.14f}, {0.09f, 0.1f}, {0.0f, 0.16f}};
  const std::uint32_t warm =
      street.builder.add_mesh("lantern", turned_shape(lantern, 10), street.builder.add_glow("lantern", kWarm * 6.0f));
  const std::uint32_t cool = street.builder.add_mesh("cool lantern", turned_shape(lantern, 10),
                                                     street.builder.add_glow("cool lantern", kCool * 6.0f));
  constexpr double kPier = 0.5 * (kStreetKerbX + kStreetFacadeX);
  const WallLamp lamps[] = {
      {"pier south left", {-kPier, 2.7, kGateSouthZ}, {0, 0, 1}, kWarm, 7.0f, false},
      {"pier south right", {kPier, 2.7, kGateSouthZ}, {0, 0, 1}, kWarm, 7.0f, false},
      {"pier north left", {-kPier, 2.7, kGateNorthZ}, {0, 0, -1}, kCool, 7.0f, false},
      {"pier north right", {kPier, 2.7, kGateNorthZ}, {0, 0, -1}, kCool, 7.0f, false},
      {"alley mouth", {8.6, 2.75, kAlleyNorthZ}, {0, 0, 1}, kWarm, 22.0f, true},
      {"alley door", {11.9, 2.6, kAlleyNorthZ}, {0, 0, 1}, kCool, 12.0f, false},
      {"alley end", {kAlleyEndX, 2.8, -20.6}, {-1, 0, 0}, vec3(1.0f, 0.36f, 0.22f), 8.0f, false},
      {"terrace door", {kTerraceBackX, kTerraceFloorY + 2.75, -9.9}, {-1, 0, 0}, kWarm, 22.0f, true},
      {"terrace end", {kTerraceBackX, kTerraceFloorY + 2.75, -14.1}, {-1, 0, 0}, kWarm, 22.0f, true},
      {"terrace side", {9.9, kTerraceFloorY + 2.6, kTerraceFrontZ}, {0, 0, -1}, kCool, 7.0f, false},
      {"tower left", {-1.45, 3.2, kStreetNorthZ + 0.2}, {0, 0, 1}, kWarm, 7.0f, false},
      {"tower right", {1.45, 3.2, kStreetNorthZ + 0.2}, {0, 0, 1}, kWarm, 7.0f, false},
  };
  for (const WallLamp& lamp : lamps) {
    const dvec3 place = lamp.at + lamp.outward * 0.13;
    street.builder.add_instance("lantern", lamp.color == kCool ? cool : warm, place);
    // A lamp that casts shadows shines away from its wall, so that the wall is not in its map.
    StreetLamp light{.color = lamp.color, .candela = lamp.candela, .range_m = 6.5f, .width_m = 0.06f};
    if (lamp.casts) light.outer_angle = 1.2f;
    add_street_lamp(street, lamp.name, light, place, 0.75 * lamp.outward - dvec3(0.0, 1.0, 0.0), lamp.casts);
  }
}

/// Bulbs on two cords over the terrace.
void add_street_garlands(Street& street) {
  const std::uint32_t bulb = street.builder.add_mesh("small bulb", sphere_shape(0.055f, 10),
                                                     street.builder.add_glow("small bulb", kWarm * 9.0f));
  const std::uint32_t cord =
      street.builder.add_mesh("cord", box_shape({0.012f, 0.012f, 1.0f}), street.materials.rubber);
  const std::uint32_t pole = street.builder.add_mesh("pole", box_shape({0.05f, 2.7f, 0.05f}), street.materials.iron);
  int count = 0;
  for (const double z : {-9.2, -14.2}) {
    dvec3 last(kStreetFacadeX + 0.1, kTerraceFloorY + 2.68, z);
    street.builder.add_instance("pole", pole, {last.x, kTerraceFloorY, z});
    for (int i = 1; i <= 5; ++i) {
      const double t = i / 5.0;
      const dvec3 next(kStreetFacadeX + 0.1 + 7.4 * t, kTerraceFloorY + 2.68 + 0.35 * t - 1.7 * t * (1.0 - t), z);
      const Entity piece =
          street.builder.add_instance("cord", cord, 0.5 * (last + next), 0.0, {1.0, 1.0, glm::length(next - last)});
      street.world.get<LocalTransform>(piece).rotation = rotation_towards(next - last);
      if (i < 5) {
        street.builder.add_instance("small bulb", bulb, next - dvec3(0.0, 0.06, 0.0));
        add_street_lamp(street, "garland " + std::to_string(count++),
                        {.color = kWarm, .candela = 4.2f, .range_m = 5.0f, .width_m = 0.1f},
                        next - dvec3(0.0, 0.06, 0.0), {0.0, -1.0, 0.0}, false);
      }
      last = next;
    }
  }
}

/// Lamps below the canopy and in the passage, and a wash of light on the clock tower.
void add_hidden_lamps(Street& street) {
  const std::uint32_t disc = street.builder.add_mesh("ceiling lamp", sphere_shape(0.08f, 12),
                                                     street.builder.add_glow("ceiling lamp", kWarm * 7.0f));
  const auto add_ceiling_lamp = [&](const std::string& name, dvec3 at, float candela) {
    street.builder.add_instance("ceiling lamp", disc, at);
    add_street_lamp(street, name, {.color = kWarm, .candela = candela, .range_m = 5.0f, .width_m = 0.16f}, at,
                    {0.0, -1.0, 0.0}, false);
  };
  for (int i = 0; i < 2; ++i)
    add_ceiling_lamp("canopy " + std::to_string(i), {kStreetFacadeX - 0.8, 3.22, -2.4 - 2.2 * i}, 4.0f);
  add_ceiling_lamp("passage", {0.0, kGateHeight - 0.12, 0.5 * (kGateSouthZ + kGateNorthZ)}, 12.0f);
  for (const double side : {-1.0, 1.0})
    add_street_lamp(street, side < 0.0 ? "wash left" : "wash right",
                    {.color = kCool, .candela = 40.0f, .range_m = 14.0f, .width_m = 0.1f, .outer_angle = 0.5f},
                    {side * 1.2, 0.4, kStreetNorthZ + 2.4}, {-side * 0.05, 1.0, -0.2}, false);
}

}  // namespace

void add_street_lights(Street& street) {
  add_street_lamps(street);
  add_street_fire(street, {-2.2, 0.0, -4.6});
  add_wall_lamps(street);
  add_street_garlands(street);
  add_hidden_lamps(street);
}

}  // namespace gloam
