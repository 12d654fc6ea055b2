// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "shaders/shadows/shadows_shared.h"
#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

using test::turn_towards;

/// Penumbrae of whole frames compared with traced ones, with the filters that have penumbrae.
class ShadowPenumbrae : public test::HardShadows, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (!IsSkipped()) set("shadows.filter", GetParam());
  }
};

// Hard case: selftest.light_width
TEST_P(ShadowPenumbrae, of_wide_lights_of_every_kind_are_right_from_both_kinds_of_camera) {
  yard();
  const std::vector<std::pair<const char*, Entity>> lamps = {
      {"point", lamp(point(0.3f), dvec3(-1.3, 1.9, 1.1))},
      {"spot", lamp(spot(35.0, 0.5f), dvec3(1.9, 2.1, -0.7), dvec3(-1.9, -1.9, 0.7))},
      {"sun", lamp(sun(0.3f), dvec3(0.0), dvec3(0.5, -0.6, -0.4))}};
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic = orthographic;
    settings.camera.half_height_m = 1.6f;
    settings.camera.half_width_m = 1.6f * 96.0f / 54.0f;
    const TracedVisibility traced = trace();
    for (const auto& [name, lamp] : lamps) {
      const ShadowError e = error(lamp, traced);
      expect_right(std::string(name) + (orthographic ? " orthographic" : " perspective"), e);
      EXPECT_GE(e.penumbra_pairs, test::kFewestPenumbraPairs) << name;
    }
  }
}

// Hard case: shadows.penumbra_2_faces, shadows.penumbra_3_faces
TEST_P(ShadowPenumbrae, across_two_and_three_faces_of_a_cube_are_as_right_as_inside_one) {
  const Entity wall = thing(test::quad(2.5f, stone)), bar = thing(test::box(vec3(0.25f, 0.25f, 0.03f), stone));
  const Entity bulb = lamp(point(0.2f), dvec3(0.0), dvec3(0.0, 0.0, -1.0));
  const dmat4 camera = test::look_at(dvec3(0.9, 0.7, 0.4), dvec3(0.0, 0.0, -3.0), 96, 54).world_from_camera;
  double inside = 0.0;  // worst error inside one face, which depends on how edges lie on texels
  for (const auto& [name, direction] : {std::pair{"one face", dvec3(0.0, 0.0, -1.0)},
                                        {"one face above", dvec3(0.2, 0.3, -1.0)},
                                        {"one face below", dvec3(-0.3, -0.1, -1.0)},
                                        {"two faces", dvec3(1.0, 0.0, -1.0)},
                                        {"two faces below", dvec3(0.0, -1.0, -1.0)},
                                        {"three faces", dvec3(1.0, 1.0, -1.0)},
                                        {"three faces behind", dvec3(-1.0, -1.0, 1.0)}}) {
    const dmat4 turn = turn_towards(mat3(GLOAM_CUBE_X, GLOAM_CUBE_Y, GLOAM_CUBE_Z) * vec3(direction));  // cube axes
    place(wall, turn * at(0.0, 0.0, -3.0));
    place(bar, turn * at(0.05, -0.03, -1.4));
    settings.world_from_camera = turn * camera;
    const ShadowError e = error(bulb, trace());
    expect_right(name, e);
    EXPECT_GT(e.penumbra_pairs, 150u) << name;
    if (std::abs(direction.x) < 0.5 && std::abs(direction.y) < 0.5) inside = std::max(inside, e.penumbra_mean());
    EXPECT_LE(e.penumbra_mean(), inside + 0.015) << name;
  }
}

// Hard case: shadows.lamp_in_housing
TEST_P(ShadowPenumbrae, of_a_wide_bulb_inside_its_housing_are_right) {
  floor();
  const double half = 0.06, height = 0.7;
  box(dvec3(0.0, height + half, 0.0), dvec3(half, 0.002, half));
  for (const double side : {-1.0, 1.0}) {
    box(dvec3(side * half, height, 0.0), dvec3(0.002, half, half));
    box(dvec3(0.0, height, side * half), dvec3(half, half, 0.002));
  }
  const Entity bulb = lamp(point(0.03f), dvec3(0.0, height, 0.0));
  settings = test::look_at(dvec3(0.5, 1.6, 2.2), dvec3(0.0, 0.2, -0.3), 96, 54);
  const ShadowError e = error(bulb, trace());
  expect_right("housing, wide bulb", e, 3000);
  EXPECT_EQ(e.leaks, 0u);
}

// Hard case: shadows.blocker_near_emitter
TEST_P(ShadowPenumbrae, of_a_blocker_nearer_than_the_emitter_is_wide_are_right) {
  thing(test::quad(2.5f, stone), at(0.0, 0.0, -2.0));
  thing(test::box(vec3(0.08f, 0.08f, 0.005f), stone), at(0.02, 0.01, -0.3));
  const Entity bulb = lamp(point(0.4f), dvec3(0.0));
  settings = test::look_at(dvec3(1.2, 0.5, 1.2), dvec3(0.0, 0.0, -2.0), 96, 54);
  const ShadowError e = error(bulb, trace());
  print("blocker at 0.3 m, emitter 0.4 m", e);
  EXPECT_GE(e.penumbra_pairs, 2000u);  // nearly the whole wall is penumbra
  EXPECT_LE(e.penumbra_mean(), test::kMostPenumbraMean);
  EXPECT_EQ(e.wrong, 0u);
  expect_finite("blocker nearer than the emitter is wide");
}

INSTANTIATE_TEST_SUITE_P(SingleFetches, ShadowPenumbrae, ::testing::Values("pcss"),
                         [](const auto& filter) { return std::string(filter.param); });
INSTANTIATE_TEST_SUITE_P(Mips, ShadowPenumbrae, ::testing::Values("chs"),
                         [](const auto& filter) { return std::string(filter.param); });

}  // namespace
}  // namespace gloam
