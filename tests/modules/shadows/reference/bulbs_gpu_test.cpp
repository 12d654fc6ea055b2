// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

/// A lamp of 20 cm above a floor, with things around and in it.
class LampParts : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    glow = exact(0.9f);
    floor();
    box(dvec3(0.5, 0.2, 0.3), dvec3(0.2), 0.4);
    bulb_lamp = lamp(point(0.2f), kPlace);
  }
  /// An emissive material.
  [[nodiscard]] std::uint32_t exact(float luminance) {
    Material material = exact_material(20, 20, 20, 255, 0);
    material.emissive = vec3(luminance);
    return scene.material(material);
  }
  /// Sums of the lamp's drawn and traced visibility over the picture.
  struct Light {
    double drawn = 0.0;
    double traced = 0.0;
    std::size_t pixels = 0;
    [[nodiscard]] double share() const { return traced / static_cast<double>(pixels); }
  };
  [[nodiscard]] Light light_of(Entity lamp) {
    const TracedVisibility traced = trace(256);
    const auto layer = traced.layer_of(lamp);
    const std::vector<float> seen = visibility(lamp);
    Light sums;
    for (std::size_t i = 0; layer && i < seen.size(); ++i) {
      if (seen[i] < 0.0f) continue;
      sums.drawn += static_cast<double>(seen[i]);
      sums.traced += traced.visibility[*layer * traced.pixels() + i] / 255.0;
      ++sums.pixels;
    }
    return sums;
  }
  const dvec3 kPlace = dvec3(0.1, 1.6, 0.2);
  std::uint32_t glow = 0;
  Entity bulb_lamp;
};

TEST_F(LampParts, bulbs_give_the_light_that_rays_give) {
  const double bare = light_of(bulb_lamp).share();
  ASSERT_GT(bare, 0.5);
  for (const float radius : {0.02f, 0.05f, 0.08f, 0.098f}) {
    const Entity bulb = thing(test::ball(radius, glow), glm::translate(dmat4(1.0), kPlace));
    const Light light = light_of(bulb_lamp);
    EXPECT_NEAR(light.drawn, light.traced, 0.02 * light.traced) << radius;
    EXPECT_NEAR(light.share(), bare, 0.01) << radius;
    world.destroy(bulb);
  }
}

// Hard case: further.light_inside_geometry
TEST_F(LampParts, a_ball_that_does_not_shine_takes_the_light) {
  thing(test::ball(0.14f, stone), glm::translate(dmat4(1.0), kPlace));
  const Light light = light_of(bulb_lamp);
  EXPECT_LT(light.share(), 0.05);
  EXPECT_LT(light.drawn, 0.05 * static_cast<double>(light.pixels));
}

TEST_F(LampParts, a_bulb_casts_into_the_maps_of_other_lamps) {
  thing(test::ball(0.098f, glow), glm::translate(dmat4(1.0), kPlace));
  const Entity other = lamp(point(0.05f), kPlace + dvec3(-0.2, 0.9, 0.1));
  const Light light = light_of(other);
  EXPECT_NEAR(light.drawn, light.traced, 0.02 * light.traced);
  expect_right("another lamp above the bulb", other);
  const double with = light.share();
  world.destroy(things[things.size() - 2]);
  EXPECT_GT(light_of(other).share(), with + 0.003);
}

TEST_F(LampParts, two_lamps_in_one_housing_shine_both) {
  const Entity twin = lamp(point(0.2f), kPlace + dvec3(0.12, 0.0, 0.0));
  thing(test::ball(0.16f, glow), glm::translate(dmat4(1.0), kPlace + dvec3(0.06, 0.0, 0.0)));
  for (const Entity lamp : {bulb_lamp, twin}) {
    const Light light = light_of(lamp);
    EXPECT_NEAR(light.drawn, light.traced, 0.02 * light.traced);
    EXPECT_GT(light.share(), 0.5);
  }
}

TEST_F(LampParts, a_bulb_that_moves_out_of_its_lamp_casts_and_back_again_does_not) {
  const Entity bulb = thing(test::ball(0.05f, glow), glm::translate(dmat4(1.0), kPlace));
  const std::vector<float> inside = visibility(bulb_lamp);
  place(bulb, glm::translate(dmat4(1.0), kPlace - dvec3(0.0, 0.5, 0.0)));
  expect_right("below the lamp", bulb_lamp);
  EXPECT_NE(visibility(bulb_lamp), inside);
  place(bulb, glm::translate(dmat4(1.0), kPlace));
  EXPECT_EQ(visibility(bulb_lamp), inside);
}

// Half of each lamp is below the floor, and the floor's face lies inside the emitter.
TEST_F(LampParts, a_lamp_two_centimetres_above_a_plane_gives_the_light_that_rays_give) {
  const Entity low = lamp(point(0.0f), dvec3(0.1, 0.02, 0.2));
  for (const float width : {0.05f, 0.1f, 0.2f}) {
    world.get<gloam::Light>(low).width_m = width;
    world.mark_changed<gloam::Light>(low);
    const Light light = light_of(low);
    EXPECT_GT(light.share(), 0.1) << width;
    EXPECT_NEAR(light.drawn, light.traced, 0.02 * light.traced) << width;
  }
}

TEST_F(LampParts, a_mesh_that_casts_no_shadow_blocks_neither_maps_nor_rays) {
  const std::vector<float> bare = visibility(bulb_lamp);
  const TracedVisibility bare_rays = trace();
  const Entity shade = thing(test::ball(0.3f, stone), glm::translate(dmat4(1.0), kPlace));
  const auto changes = [&] {
    const std::vector<float> now = visibility(bulb_lamp);
    const TracedVisibility rays = trace();
    std::size_t changed = 0;
    for (std::size_t i = 0; i < bare.size(); ++i)
      changed += now[i] != bare[i] || rays.visibility[i] != bare_rays.visibility[i] ? 1 : 0;
    return changed;
  };
  EXPECT_GT(changes(), bare.size() / 4);
  world.get<MeshInstance>(shade).casts_shadows = false;
  EXPECT_LT(changes(), bare.size() / 10) << "the pixels that show the ball itself";
}

}  // namespace
}  // namespace gloam
