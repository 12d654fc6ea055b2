// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "modules/shadows/components.h"
#include "tests/modules/grass/support/stems.h"

namespace gloam::test {
namespace {

/// One wide blade on level ground under a light that shines on its broad side.
class GrassShadows : public GrassTest {
 protected:
  static constexpr double kBlur_m = 0.08;  // half a blade, and some texels of a shadow map

  void plant(GrassStage& stage) {
    stage.world.resource<SceneEnvironment>() = {
        .sky_zenith = vec3(0.05f), .sky_horizon = vec3(0.05f), .sky_ground = vec3(0.05f)};
    stage.set("grass.lod_pixels", "0");
    GrassSurface values;
    values.width_m = 0.08f;
    values.height_m = vec2(0.5f, 0.0f);
    stage.lawn(1.5f, 1, dvec3(0.0), values);
    stage.draw(look_at({0.0, 6.0, 0.1}, {0.0, 0.0, 0.0}, 96, 64));
    const std::vector<Stem> stems = stems_of(stage.field(), stage.copy(), dvec3(0.0));
    ASSERT_EQ(stems.size(), 1u);
    blade = stems[0];
    const dvec3 across = glm::normalize(dvec3(blade.side.x, 0.0, blade.side.z));
    toward_sun = glm::normalize(dvec3(across.z, 1.0, -across.x));
    light_at = blade.at[0] + 1000.0 * toward_sun;
  }
  /// A point light in place of the sun.
  void light_by_lamp(GrassStage& stage) {
    light_at = blade.at[0] + 2.0 * toward_sun;
    Light lamp;
    lamp.intensity = 12.0f;
    lamp.range_m = 10.0f;
    stage.world.create(lamp, ShadowCaster{}, WorldTransform{glm::translate(dmat4(1.0), light_at)});
  }
  /// A camera over the blade at this distance.
  [[nodiscard]] ViewSettings over(double distance_m) const {
    ViewSettings view = look_at(blade.at[0] + distance_m * glm::normalize(dvec3(0.3, 1.0, 0.2)), blade.at[0], 96, 64);
    view.camera.fov_y = static_cast<float>(2.0 * std::atan(0.9 / distance_m));
    return view;
  }
  struct Change {
    std::size_t ground = 0;   ///< pixels
    std::size_t darker = 0;   ///< by more than 30 %
    double farthest_m = 0.0;  ///< of the blade from the ray between a darker point and the light
    std::size_t other = 0;    ///< not darker, but different
  };
  /// Changes of the ground's light by the blade's shadow.
  [[nodiscard]] Change change(GrassStage& stage, const ViewSettings& view, const char* cast_distance) {
    stage.set("grass.cast_distance", "0");
    const GrassPicture picture = grass_picture(stage, view);
    stage.draw(view);
    const LinearPicture lit = stage.linear();
    stage.set("grass.cast_distance", cast_distance);
    stage.draw(view);
    const LinearPicture shadowed = stage.linear();
    Change found;
    for (std::size_t i = 0; i < picture.with.depth.size(); ++i) {
      if (picture.is_grass(i) || picture.with.is_sky(i)) continue;
      ++found.ground;
      const float before = lit.rgba[4 * i + 1], after = shadowed.rgba[4 * i + 1];
      if (after >= 0.7f * before) {
        found.other += std::abs(after - before) > 0.01f * before ? 1 : 0;
        continue;
      }
      ++found.darker;
      const dvec3 point = picture.world(i);
      double nearest = 1e9;
      for (int step = 0; step <= 100; ++step)
        nearest = std::min(nearest, blade.distance_to(point + glm::normalize(light_at - point) * (0.015 * step)));
      found.farthest_m = std::max(found.farthest_m, nearest);
    }
    return found;
  }

  Stem blade;
  dvec3 toward_sun = dvec3(0.0, 1.0, 0.0);
  dvec3 light_at = dvec3(0.0);
};

TEST_F(GrassShadows, fall_on_the_ground_behind_the_blade_within_the_cast_distance) {
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.sun(-toward_sun);
  const Change near = change(stage, over(3.0), "6");
  EXPECT_GT(near.ground, 2000u);
  EXPECT_GT(near.darker, 20u);
  EXPECT_LT(near.farthest_m, kBlur_m);
  const Change far = change(stage, over(8.0), "6");
  EXPECT_GT(far.ground, 2000u);
  EXPECT_EQ(far.darker, 0u);
  EXPECT_EQ(far.other, 0u);
  EXPECT_GT(change(stage, over(8.0), "12").darker, 20u);
}

// Light of the ground and the blades of a dense lawn in the sun, seen from above: with the shadows of all blades, with
// those of a quarter of them, which are four times as wide, and with none.
TEST_F(GrassShadows, of_a_quarter_of_a_dense_lawn_take_as_much_light_as_those_of_all) {
  GrassStage stage({.shadows = true});
  GrassSurface values;
  values.density = 900.0f;
  values.width_m = 0.006f;
  values.height_m = vec2(0.25f, 0.05f);
  stage.lawn(3.0f, 2700, dvec3(0.0), values);
  stage.sun(glm::normalize(dvec3(0.5, -1.0, 0.2)));
  const ViewSettings view = look_at({0.0, 2.5, 1.5}, {0.0, 0.0, 0.0}, 128, 96);
  const auto light = [&](const char* distance, const char* casters) {
    stage.set("grass.cast_distance", distance);
    stage.set("grass.casters", casters);
    stage.draw(view);
    double sum = 0.0;
    const LinearPicture picture = stage.linear();
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) sum += double{picture.rgba[i + 1]};
    return sum;
  };
  const double none = light("0", "1:1"), all = light("6", "1:1");
  EXPECT_LT(all, 0.985 * none);
  for (const char* casters : {"1:2", "1:4"}) {
    const double some = light("6", casters);
    EXPECT_NEAR((none - some) / (none - all), 1.0, 0.12) << casters << ": " << none << ", " << all << ", " << some;
  }
}

TEST_F(GrassShadows, of_a_lamp_fall_behind_the_blade) {
  GrassStage stage({.shadows = true});
  plant(stage);
  light_by_lamp(stage);
  const Change near = change(stage, over(3.0), "6");
  EXPECT_GT(near.ground, 2000u);
  EXPECT_GT(near.darker, 20u);
  EXPECT_LT(near.farthest_m, kBlur_m);
  EXPECT_EQ(change(stage, over(8.0), "6").darker, 0u);
}

TEST_F(GrassShadows, of_a_blade_out_of_view_fall_into_it) {
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.sun(-toward_sun);
  // Only the end of the shadow is in the picture.
  const dvec3 tip = blade.at[kGrassKnots - 1];
  const dvec3 end = tip - toward_sun * (tip.y / toward_sun.y);
  ViewSettings view = look_at(end + dvec3(0.0, 2.0, 0.001), end, 96, 64);
  view.camera.fov_y = 0.08f;
  const GrassPicture picture = grass_picture(stage, view);
  EXPECT_EQ(picture.grass_pixels(), 0u);
  const Change found = change(stage, view, "6");
  EXPECT_GT(found.darker, 20u);
  EXPECT_LT(found.farthest_m, kBlur_m);
}

TEST_F(GrassShadows, of_other_things_fall_on_blades) {
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.sun(-toward_sun);
  stage.set("grass.cast_distance", "0");
  const dvec3 middle = blade.at[kGrassKnots / 2];
  const ViewSettings view =
      look_at(middle + 1.2 * glm::normalize(dvec3(toward_sun.x, 0.3, toward_sun.z)), middle, 96, 64);
  const GrassPicture picture = grass_picture(stage, view);
  stage.draw(view);
  const LinearPicture lit = stage.linear();
  stage.scene.draw(stage.scene.mesh(box(vec3(1.0f, 0.02f, 1.0f))),
                   glm::translate(dmat4(1.0), blade.at[0] + 6.0 * toward_sun));
  stage.draw(view);
  const LinearPicture shadowed = stage.linear();
  std::size_t blade_pixels = 0, darker = 0;
  for (std::size_t i = 0; i < picture.with.depth.size(); ++i) {
    if (!picture.is_grass(i)) continue;
    ++blade_pixels;
    darker += shadowed.rgba[4 * i + 1] < 0.7f * lit.rgba[4 * i + 1] ? 1 : 0;
  }
  EXPECT_GT(blade_pixels, 30u);
  EXPECT_GT(darker, blade_pixels * 9 / 10) << "of " << blade_pixels;
}

TEST_F(GrassShadows, of_two_views_are_those_of_each_alone) {
  std::vector<float> alone[2];
  for (const std::uint32_t i : {0u, 1u}) {
    GrassStage stage({.shadows = true});
    plant(stage);
    stage.sun(-toward_sun);
    stage.draw(over(i == 0 ? 3.0 : 2.0));
    alone[i] = stage.linear().rgba;
  }
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.sun(-toward_sun);
  ViewSettings views[] = {over(3.0), over(2.0)};
  views[1].id = ViewId{1};
  stage.draw(views);
  for (const std::uint32_t i : {0u, 1u}) {
    const std::vector<float> both = stage.linear(ViewId{i}).rgba;
    std::size_t different = 0;
    for (std::size_t n = 0; n < both.size(); ++n) different += std::abs(both[n] - alone[i][n]) <= 0.05f ? 0 : 1;
    EXPECT_LT(different, both.size() / 200) << "view " << i;
  }
}

}  // namespace
}  // namespace gloam::test
