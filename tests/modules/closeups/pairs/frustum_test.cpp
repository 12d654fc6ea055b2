// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/frustum.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/modules/closeups/cases.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

/// A point as a face sees it: half extents from the centre, and metres along the axis.
dvec3 seen(const ShadowFace& face, const dvec3& world) {
  const dvec3 to = world - face.origin;
  const double z = glm::dot(dvec3(face.forward), to);
  const double half = face.kind == LightKind::directional ? static_cast<double>(face.half_extent_m)
                                                          : z * static_cast<double>(face.tan_half);
  return {glm::dot(dvec3(face.right), to) / half, glm::dot(dvec3(face.up), to) / half, z};
}

double greater(const dvec3& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

void expect_axes(const ShadowFace& face) {
  EXPECT_NEAR(glm::length(face.right), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::length(face.up), 1.0f, 1e-5f);
  EXPECT_LT(glm::length(glm::cross(face.right, face.up) + face.forward), 1e-5f) << "not mirrored, at right angles";
}

class CloseupFrustumTest : public ::testing::Test {
 protected:
  [[nodiscard]] Light lamp(LightKind kind) {
    Light light;
    light.kind = kind;
    light.range_m = static_cast<float>(cases_.in(2.0, 30.0));
    light.width_m = cases_.chance(0.3) ? 0.0f : static_cast<float>(cases_.in(0.0, 1.0));
    light.apparent_angle = cases_.chance(0.3) ? 0.0f : static_cast<float>(cases_.in(0.0, 0.3));
    light.outer_angle = static_cast<float>(cases_.in(0.02, 1.6));
    return light;
  }
  [[nodiscard]] std::uint32_t size() { return 64u << static_cast<std::uint32_t>(cases_.in(0.0, 5.99)); }

  test::CloseupCases cases_{5};
};

TEST_F(CloseupFrustumTest, a_local_map_holds_the_box_and_the_penumbra_and_has_an_empty_border) {
  int made = 0;
  int by_cone = 0;
  for (int round = 0; round < test::scaled(4000); ++round) {
    const dvec3 world = cases_.chance(0.2) ? cases_.point(1e5) : dvec3(0.0);
    const WorldBox subject = cases_.box(world + cases_.point(4.0), 0.05, 2.0);
    const dvec3 middle = (subject.min + subject.max) * 0.5;
    const CloseupLight light =
        *closeup_light(lamp(cases_.chance(0.5) ? LightKind::point : LightKind::spot),
                       cases_.looking(world, glm::normalize(middle - world + cases_.point(1.0))));
    const auto frustum = closeup_frustum(light, subject, {}, size());
    if (!frustum) continue;
    ++made;
    const ShadowFace& face = frustum->face;
    expect_axes(face);
    ASSERT_EQ(face.kind, LightKind::spot);
    ASSERT_EQ(face.origin, light.position);
    ASSERT_GT(face.near_m, 0.0f);
    ASSERT_LT(face.near_m, face.far_m);
    ASSERT_NEAR(face.far_m, light.range_m, 1e-5 * light.range_m);
    ASSERT_LE(face.tan_half, 2.0f);
    const double texel = 2.0 / face.square.size;
    const double inner = static_cast<double>(frustum->tan_inner) / static_cast<double>(face.tan_half);
    ASSERT_LE(inner, 1.0 - 2.0 * texel) << "a rim of two texels";
    const bool cone = light.kind == LightKind::spot &&
                      std::abs(static_cast<double>(frustum->tan_inner) - std::tan(light.half_angle)) < 1e-6;
    by_cone += cone ? 1 : 0;
    if (cone) {
      EXPECT_LT(glm::length(dvec3(face.forward) - light.forward), 1e-6);
    }
    double widest = 0.0;
    for (int sample = 0; sample < 60; ++sample) {
      const dvec3 at = seen(face, cases_.inside(subject));
      ASSERT_TRUE(at.z <= 0.0 || at.z >= static_cast<double>(face.near_m)) << "near plane";
      ASSERT_TRUE(cone || greater(at) <= inner);
      const auto hidden = cases_.hidden(light, subject, {}, cases_.chance(0.5) ? 1.0 : cases_.in(0.0, 1.0));
      if (!hidden) continue;
      const dvec3 shown = seen(face, hidden->receiver);
      ASSERT_GT(shown.z, 0.0);
      ASSERT_LE(greater(shown), inner * (1.0 + 1e-6));
      widest = std::max(widest, greater(seen(face, hidden->receiver)));
    }
  }
  EXPECT_GT(made, test::scaled(1000));
  EXPECT_GT(by_cone, test::scaled(100));
}

TEST_F(CloseupFrustumTest, a_local_map_is_no_wider_than_it_must_be) {
  double sum = 0.0;
  for (int round = 0; round < 100; ++round) {
    const dvec3 at = cases_.direction() * cases_.in(3.0, 8.0);
    const WorldBox subject = cases_.box(at, 0.5, 2.0);
    Light light = lamp(LightKind::point);
    light.range_m = 1e5f;
    light.width_m = std::min(light.width_m, 0.3f);
    const CloseupLight placed = *closeup_light(light, dmat4(1.0));
    const auto frustum = closeup_frustum(placed, subject, {}, 2048);
    ASSERT_TRUE(frustum);
    double widest = 0.0;
    for (int sample = 0; sample < 2000; ++sample)
      if (const auto hidden = cases_.hidden(placed, subject, {}, 1.0))
        widest = std::max(widest, greater(seen(frustum->face, hidden->receiver)));
    sum += 1.0 / widest;
  }
  EXPECT_LT(sum / 100, 1.05);
}

TEST_F(CloseupFrustumTest, a_directional_map_holds_the_box_and_the_penumbra_to_the_end_of_the_scene) {
  for (int round = 0; round < test::scaled(2000); ++round) {
    const dvec3 world = cases_.chance(0.2) ? cases_.point(1e5) : dvec3(0.0);
    const WorldBox subject = cases_.box(world + cases_.point(4.0), 0.0, 2.0);
    WorldBox scene = cases_.box(world, 0.0, 30.0);
    scene = {glm::min(scene.min, subject.min), glm::max(scene.max, subject.max)};
    const CloseupLight light =
        *closeup_light(lamp(LightKind::directional), cases_.looking(cases_.point(9.0), cases_.direction()));
    const auto frustum = closeup_frustum(light, subject, scene, size());
    ASSERT_TRUE(frustum);
    const ShadowFace& face = frustum->face;
    expect_axes(face);
    ASSERT_EQ(face.kind, LightKind::directional);
    ASSERT_EQ(face.tan_half, 0.0f);
    ASSERT_EQ(face.near_m, 0.0f);
    EXPECT_LT(glm::length(dvec3(face.forward) - light.forward), 1e-6);
    const double inner = 1.0 - 4.0 / face.square.size;
    double nearest = 1e9;
    for (int c = 0; c < 8; ++c)
      nearest =
          std::min(nearest, seen(face, {c & 1 ? subject.max.x : subject.min.x, c & 2 ? subject.max.y : subject.min.y,
                                        c & 4 ? subject.max.z : subject.min.z})
                                .z);
    EXPECT_GE(nearest, 0.0);
    EXPECT_LT(nearest, 1e-3) << "the near side is at the subject";
    for (int sample = 0; sample < 60; ++sample) {
      ASSERT_LE(greater(seen(face, cases_.inside(subject))), inner);
      const auto hidden = cases_.hidden(light, subject, scene, cases_.chance(0.5) ? 1.0 : cases_.in(0.0, 1.0));
      if (!hidden) continue;
      const dvec3 shown = seen(face, hidden->receiver);
      ASSERT_LE(greater(shown), inner + 1e-6);
      ASSERT_LE(shown.z, static_cast<double>(face.far_m));
      ASSERT_GE(shown.z, 0.0);
    }
  }
}

TEST_F(CloseupFrustumTest, there_is_none_round_the_light_or_without_numbers) {
  Light light;
  light.range_m = 10.0f;
  const CloseupLight hard = *closeup_light(light, dmat4(1.0));
  EXPECT_FALSE(closeup_frustum(hard, {dvec3(-1.0), dvec3(1.0)}, {}, 512)) << "in the subject";
  EXPECT_FALSE(closeup_frustum(hard, {dvec3(-1.0, -1.0, -1.4), dvec3(1.0, 1.0, -0.4)}, {}, 512))
      << "beyond a tangent of 2";
  const WorldBox near{dvec3(-0.1, -0.1, -0.7), dvec3(0.1, 0.1, -0.5)};
  EXPECT_TRUE(closeup_frustum(hard, near, {}, 512));
  light.width_m = 1.1f;
  EXPECT_FALSE(closeup_frustum(*closeup_light(light, dmat4(1.0)), near, {}, 512)) << "the emitter reaches into it";
  light.kind = LightKind::spot;
  light.outer_angle = 0.3f;
  EXPECT_FALSE(closeup_frustum(*closeup_light(light, dmat4(1.0)), near, {}, 512)) << "a cone does not help";
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(closeup_frustum(hard, {near.min, dvec3(bad)}, {}, 512));
    dmat4 node(1.0);
    node[3].x = bad;
    EXPECT_FALSE(closeup_light(light, node));
  }
  EXPECT_FALSE(closeup_frustum(hard, {}, {}, 512));
}

TEST_F(CloseupFrustumTest, axes_do_not_spin_as_the_subject_walks_under_the_light) {
  const double step = 0.01;
  for (const double offset : {0.0, 1e-9, 0.001, 0.5, 3.0}) {
    CloseupAxes last = closeup_axes(glm::normalize(dvec3(-5.0, -3.0, offset)));
    for (double x = -5.0 + step; x < 5.0; x += step) {
      const CloseupAxes axes = closeup_axes(glm::normalize(dvec3(x, -3.0, offset)));
      const float turned = glm::length(axes.forward - last.forward);
      ASSERT_LT(glm::length(axes.right - last.right), 1.5f * turned + 1e-5f);
      ASSERT_LT(glm::length(axes.up - last.up), 1.5f * turned + 1e-5f);
      last = axes;
    }
  }
  const CloseupAxes straight_up = closeup_axes(dvec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(glm::length(straight_up.right), 1.0f, 1e-6f);
}

TEST(CloseupSize, is_a_power_of_two_that_follows_the_pixels_within_the_maps_room) {
  CloseupSettings settings;
  settings.map_size = 2048;
  settings.texels_per_pixel = 3.0f;
  const auto across = [](std::uint32_t tiles) { return TileRange{uvec2(3), uvec2(3 + tiles, 4)}; };
  EXPECT_EQ(closeup_size(settings, across(1)), 64u);
  EXPECT_EQ(closeup_size(settings, across(20)), 512u) << "480 texels are asked for";
  EXPECT_EQ(closeup_size(settings, across(22)), 1024u) << "528";
  EXPECT_EQ(closeup_size(settings, across(500)), 2048u);
  EXPECT_EQ(closeup_size(settings, {}), 64u);
  for (const std::uint32_t batch : {2u, 4u}) {
    settings.batch = batch;
    EXPECT_EQ(closeup_size(settings, across(500)), 1024u);
  }
  settings.texels_per_pixel = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(closeup_size(settings, across(500)), 64u);
}

}  // namespace
}  // namespace gloam
