// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/bulbs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam {
namespace {

const double kRoot3 = std::sqrt(3.0);

/// is_bulb() for a cube around `middle` and a light at a far place.
bool cube_is_bulb(const dvec3& middle, double half, double bulb_radius_m, bool emissive = true) {
  const dvec3 light(100e3, -3.0, 20e3);
  return is_bulb(light, bulb_radius_m, light + middle - half, light + middle + half, emissive ? half * kRoot3 : 0.0);
}

TEST(Bulbs, are_emissive_meshes_in_or_at_the_emitter) {
  for (const double half : {0.001, 0.02, 0.05, 0.098, 0.2}) {
    EXPECT_TRUE(cube_is_bulb(dvec3(0.0), half, 0.1)) << half;
    EXPECT_FALSE(cube_is_bulb(dvec3(0.0), half, 0.1, false)) << "not emissive";
  }
  EXPECT_TRUE(cube_is_bulb(dvec3(0.0, 0.1 + 0.02, 0.0), 0.02, 0.1)) << "on top of the emitter";
  EXPECT_FALSE(cube_is_bulb(dvec3(0.0, 0.16 + 0.02, 0.0), 0.02, 0.1)) << "apart from it";
  EXPECT_FALSE(cube_is_bulb(dvec3(0.0, 1.0, 0.0), 0.02, 0.1)) << "a shining sign further up";
}

TEST(Bulbs, are_not_much_larger_than_the_emitter) {
  EXPECT_TRUE(cube_is_bulb(dvec3(0.0), 0.49 / kRoot3, 0.1));
  EXPECT_FALSE(cube_is_bulb(dvec3(0.0), 0.51 / kRoot3, 0.1)) << "a shining room around the light";
}

TEST(Bulbs, of_lights_without_width_scale_with_the_range) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    Light light;
    light.kind = LightKind::point;
    light.range_m = static_cast<float>(10.0 * unit);
    EXPECT_TRUE(cube_is_bulb(dvec3(0.0), 0.08 * unit, bulb_radius(light)));
    EXPECT_FALSE(cube_is_bulb(dvec3(0.0), 0.2 * unit, bulb_radius(light)));
    light.width_m = static_cast<float>(0.2 * unit);
    EXPECT_TRUE(cube_is_bulb(dvec3(0.0), 0.2 * unit, bulb_radius(light)));
  }
}

TEST(Bulbs, belong_to_local_lights_only) {
  Light sun;
  sun.kind = LightKind::directional;
  EXPECT_FALSE(cube_is_bulb(dvec3(0.0), 0.02, bulb_radius(sun)));
}

}  // namespace
}  // namespace gloam
