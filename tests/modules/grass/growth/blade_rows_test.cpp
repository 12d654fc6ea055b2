// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/blade_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/scale.h"

namespace gloam {
namespace {

GrassPatch patch_of(vec3 from, vec3 to) {
  GrassPatch patch;
  patch.roots = {from, to};
  return patch;
}

float turn_between(float a, float b) {
  const float turns = std::abs(a - b) / (2.0f * kPi);
  return std::abs(turns - std::round(turns));
}

TEST(BladeRows, a_row_gives_back_its_blade_within_the_stated_errors) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < test::scaled(20000); ++i) {
    const vec3 size = vec3(unit(random), unit(random) * 0.2f, unit(random)) * std::exp2(8.0f * unit(random) - 4.0f);
    const GrassPatch patch = patch_of(size * -0.5f, size * 0.5f);
    GrassBlade blade;
    blade.root_m = patch.roots.min + size * vec3(unit(random), unit(random), unit(random));
    blade.ground_normal = glm::normalize(vec3(unit(random) - 0.5f, unit(random) + 0.2f, unit(random) - 0.5f));
    blade.yaw = 2.0f * kPi * unit(random);
    blade.length_m = 0.01f + unit(random);
    blade.width_m = 0.001f + 0.01f * unit(random);
    blade.rank = unit(random);
    blade.slot = static_cast<std::uint32_t>(random() % 100000);
    blade.master = blade.slot - blade.slot % 256 + static_cast<std::uint32_t>(random() % 256);
    blade.type = static_cast<std::uint16_t>(random() % 16);
    blade.layer = static_cast<std::uint16_t>(random() % 16);

    const GrassBlade back = unpack_blade_row(pack_blade_row(blade, patch), patch, blade.slot);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(std::abs(back.root_m[axis] - blade.root_m[axis]), size[axis] / 65535.0f);
    EXPECT_GT(glm::dot(back.ground_normal, blade.ground_normal), std::cos(1.5f * kPi / 180.0f));
    EXPECT_LE(turn_between(back.yaw, blade.yaw), 1.0f / 256.0f);
    EXPECT_NEAR(back.length_m, blade.length_m, blade.length_m / 2048.0f);
    EXPECT_NEAR(back.width_m, blade.width_m, blade.width_m / 1024.0f);
    EXPECT_NEAR(back.rank, blade.rank, 1.0f / 509.0f);
    EXPECT_EQ(back.slot, blade.slot);
    EXPECT_EQ(back.master, blade.master);
    EXPECT_EQ(back.type, blade.type);
    EXPECT_EQ(back.layer, blade.layer);
  }
}

TEST(BladeRows, a_box_without_size_gives_back_its_point_exactly) {
  const vec3 at(0.1f, -3.0f, 7.0f);
  const GrassPatch patch = patch_of(at, at);
  GrassBlade blade;
  blade.root_m = at;
  EXPECT_EQ(unpack_blade_row(pack_blade_row(blade, patch), patch, 0).root_m, at);
  const GrassPatch flat = patch_of(vec3(-1.0f, 0.25f, -1.0f), vec3(1.0f, 0.25f, 1.0f));
  blade.root_m = vec3(1.0f, 0.25f, -1.0f);
  EXPECT_EQ(unpack_blade_row(pack_blade_row(blade, flat), flat, 0).root_m, blade.root_m);
  const float least = std::numeric_limits<float>::denorm_min();
  const GrassPatch thin = patch_of(vec3(0.0f), vec3(least));
  blade.root_m = vec3(least);
  EXPECT_EQ(unpack_blade_row(pack_blade_row(blade, thin), thin, 0).root_m, blade.root_m);
}

TEST(BladeRows, an_upright_normal_and_a_whole_turn_are_kept) {
  const GrassPatch patch = patch_of(vec3(-1.0f), vec3(1.0f));
  GrassBlade blade;
  EXPECT_NEAR(glm::length(unpack_blade_row(pack_blade_row(blade, patch), patch, 0).ground_normal - vec3(0, 1, 0)), 0.0f,
              1e-6f);
  for (const float yaw : {-0.01f, 0.0f, 6.2831f, 6.29f, -100.0f, 1e6f}) {
    blade.yaw = yaw;
    EXPECT_LE(turn_between(unpack_blade_row(pack_blade_row(blade, patch), patch, 0).yaw, yaw), 1.0f / 256.0f) << yaw;
  }
}

TEST(BladeRows, values_that_are_not_numbers_or_out_of_range_give_a_row_inside_the_box) {
  const GrassPatch patch = patch_of(vec3(-1.0f), vec3(1.0f));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinity, -infinity}) {
    GrassBlade blade;
    blade.root_m = vec3(bad);
    blade.ground_normal = vec3(bad);
    blade.yaw = bad;
    blade.rank = bad;
    const GrassBlade back = unpack_blade_row(pack_blade_row(blade, patch), patch, 0);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(back.root_m[axis]), 1.0f);
    EXPECT_NEAR(glm::length(back.ground_normal), 1.0f, 1e-5f);
    EXPECT_TRUE(back.yaw >= 0.0f && back.yaw <= 2.0f * kPi);
    EXPECT_TRUE(back.rank >= 0.0f && back.rank <= 1.0f);
  }
}

TEST(BladeRows, the_empty_row_has_no_length) {
  EXPECT_EQ(unpack_blade_row(shaders::GrassBladeRow{}, patch_of(vec3(0.0f), vec3(1.0f)), 7).length_m, 0.0f);
}

}  // namespace
}  // namespace gloam
