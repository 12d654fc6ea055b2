// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"
#include "modules/reflections/components.h"
#include "sandbox/scenes/construction/scene_builder.h"

namespace gloam {

/// Materials and facades of streets, for the scenes that have one.
struct StreetMaterials {
  std::uint32_t asphalt, pavement, kerb, tiles, roof;
  std::array<std::uint32_t, 4> walls;
  std::uint32_t trim, wood, iron, paint, brass, rubber, cloth, skin, dark_glass;
  std::array<std::uint32_t, 3> windows;  ///< lit panes with curtains
  std::array<std::uint32_t, 5> shops;    ///< lit shop windows
  std::array<std::uint32_t, 8> signs;
  std::array<vec3, 5> shop_colors;  ///< linear RGB of each shop's light
};

/// A street that is being built.
struct Street {
  World& world;
  SceneBuilder& builder;
  StreetMaterials materials;
};

[[nodiscard]] StreetMaterials add_street_materials(World& world, SceneBuilder& builder);

/// A vertical wall of a house: a relief up to 0.2 m deep before and behind its plane, and the house behind it. The
/// ground floor has shops or is blank; the floors above it have windows.
struct Facade {
  std::string name;
  dvec3 foot;            ///< middle of the lower edge, in the wall's plane
  double heading = 0.0;  ///< radians about +Y; the wall faces +Z at 0
  float width_m = 10.0f;
  float height_m = 9.0f;
  float depth_m = 6.0f;    ///< of the house behind it
  float ground_m = 3.4f;   ///< height of the ground floor; 0: windows from the foot on
  float blank_m = 0.0f;    ///< height of the wall without windows at its top
  int shops = 0;           ///< each with a door, a window, a sign and a lamp
  int columns = 4;         ///< windows on each floor above
  int low_proxies = 1;     ///< proxies side by side before the ground floor
  int high_proxies = 1;    ///< and before the other floors; 0: those below cover the whole wall
  std::uint32_t wall = 0;  ///< of StreetMaterials::walls
  std::uint32_t first_shop = 0;
};
void add_facade(Street& street, const Facade& facade);

/// A proxy of this size that faces `normal` (unit length). Its local Y is as close to up as possible.
Entity add_street_proxy(Street& street, const std::string& name, dvec3 center, dvec3 normal, vec2 size_m);

/// A lamp without a shape. A spot has outer_angle > 0.
struct StreetLamp {
  vec3 color = vec3(1.0f);
  float candela = 1.0f;
  float range_m = 5.0f;
  float width_m = 0.0f;
  float outer_angle = 0.0f;
};
void add_street_lamp(Street& street, const std::string& name, const StreetLamp& lamp, dvec3 position, dvec3 direction,
                     bool casts_shadows);

}  // namespace gloam
