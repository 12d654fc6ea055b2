// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "modules/shadows/components.h"
#include "tests/modules/grass/support/stems.h"

// grass.shadow_filter: shadows that fall on blades. One wide lamp and a box stand over a lawn whose blades cast no
// shadows, and nothing else gives light. So the light of a pixel with the box, over that without it, is its visibility,
// and rays from the pixel to points of the lamp are the truth.

namespace gloam::test {
namespace {

constexpr double kLampWidth_m = 0.3;

struct Box {
  dvec3 low, high;
  /// Whether the segment from a to b meets the box.
  [[nodiscard]] bool blocks(const dvec3& a, const dvec3& b) const {
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double way = b[axis] - a[axis];
      if (std::abs(way) < 1e-12) {
        if (a[axis] < low[axis] || a[axis] > high[axis]) return false;
        continue;
      }
      const double t0 = (low[axis] - a[axis]) / way, t1 = (high[axis] - a[axis]) / way;
      first = std::max(first, std::min(t0, t1));
      last = std::min(last, std::max(t0, t1));
    }
    return first <= last;
  }
};

class GrassShadowFilter : public GrassTest {
 protected:
  static constexpr std::size_t kRays = 256;
  // For a box of half size 0.25 × 0.02 × 0.25, halfway to the lamp: an umbra with a wide penumbra around it.
  const dvec3 lamp{0.4, 2.4, 0.3};
  const dvec3 box_at{0.2, 1.1, 0.15};
  const Box blocker{box_at - dvec3(0.25, 0.02, 0.25), box_at + dvec3(0.25, 0.02, 0.25)};
  const ViewSettings view = look_at({0.1, 1.5, 1.6}, {0.0, 0.05, 0.0}, 160, 112);

  void plant(GrassStage& stage, double lamp_width_m = kLampWidth_m) {
    stage.world.resource<SceneEnvironment>() = {
        .sky_zenith = vec3(0.0f), .sky_horizon = vec3(0.0f), .sky_ground = vec3(0.0f)};
    stage.set("grass.cast_distance", "0");
    GrassSurface values;
    values.width_m = 0.006f;
    values.height_m = vec2(0.2f, 0.04f);
    stage.lawn(1.0f, 1600, dvec3(0.0), values);
    Light light;
    light.intensity = 60.0f;
    light.range_m = 10.0f;
    light.width_m = static_cast<float>(lamp_width_m);
    stage.world.create(light, ShadowCaster{}, WorldTransform{glm::translate(dmat4(1.0), lamp)});
  }
  void add_box(GrassStage& stage) {
    stage.scene.draw(stage.scene.mesh(box(vec3(0.25f, 0.02f, 0.25f))), glm::translate(dmat4(1.0), box_at));
  }
  [[nodiscard]] std::vector<float> light(GrassStage& stage, const char* filter) {
    stage.set("grass.shadow_filter", filter);
    stage.draw(view);
    return stage.linear().rgba;
  }
  /// Share of the lamp, a sphere seen as a disc, that a point sees. wider: factor of the lamp's width.
  [[nodiscard]] double traced(const dvec3& point, double wider = 1.0) const {
    const dvec3 toward = glm::normalize(lamp - point);
    const dvec3 side = glm::normalize(glm::cross(toward, dvec3(0.0, 0.0, 1.0))), up = glm::cross(side, toward);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const double radius = 0.5 * wider * kLampWidth_m * std::sqrt((static_cast<double>(i) + 0.5) / kRays);
      const double angle = 2.39996322972865332 * static_cast<double>(i);
      const dvec3 at = lamp + side * (radius * std::cos(angle)) + up * (radius * std::sin(angle));
      seen += blocker.blocks(point, at) ? 0 : 1;
    }
    return static_cast<double>(seen) / kRays;
  }
};

struct Judged {
  std::size_t pixels = 0, partly = 0, lit = 0, unlit = 0;
  double mean = 0.0;         ///< visibility of all pixels of grass
  double error = 0.0;        ///< mean absolute difference from rays
  double least_lit = 1.0;    ///< least visibility of a pixel that rays find well lit
  std::size_t not_lit = 0;   ///< such pixels with less than all of the light
  std::size_t not_dark = 0;  ///< pixels that rays find deep in shadow, with light
};

TEST_F(GrassShadowFilter, lights_a_lawn_as_rays_do_and_lit_and_unlit_pixels_exactly) {
  GrassStage stage({.shadows = true});
  plant(stage);
  const std::vector<float> bare = light(stage, "full");
  add_box(stage);
  const GrassPicture picture = grass_picture(stage, view);
  std::vector<double> truth(picture.with.depth.size(), -1.0);
  double true_mean = 0.0;
  std::size_t judged_pixels = 0;
  const auto judged = [&](std::size_t i) {
    return picture.is_grass(i) && bare[4 * i + 1] > 1e-3f && std::abs(picture.world(i).y) < 0.4;
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!judged(i)) continue;
    truth[i] = traced(picture.world(i));
    true_mean += truth[i];
    ++judged_pixels;
  }
  ASSERT_GT(judged_pixels, 2000u);
  true_mean /= static_cast<double>(judged_pixels);
  Judged found[2];
  for (const int k : {0, 1}) {
    const std::vector<float> shadowed = light(stage, k == 0 ? "full" : "one_mip");
    Judged& f = found[k];
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!judged(i)) continue;
      const double visibility = double{shadowed[4 * i + 1]} / double{bare[4 * i + 1]};
      ++f.pixels;
      f.mean += visibility;
      f.error += std::abs(visibility - truth[i]);
      const bool is_partly = truth[i] > 0.02 && truth[i] < 0.98;
      f.partly += is_partly ? 1 : 0;
      // All of a lamp twice as wide is seen, or none of one half as wide again.
      if (traced(picture.world(i), 2.0) == 1.0) {
        ++f.lit;
        f.not_lit += visibility > 1.0 - 1e-6 ? 0 : 1;  // one of 255 steps is more
        f.least_lit = std::min(f.least_lit, visibility);
      }
      if (traced(picture.world(i), 1.5) == 0.0) {
        ++f.unlit;
        f.not_dark += visibility > 0.1 ? 1 : 0;
      }
    }
    f.mean /= static_cast<double>(f.pixels);
    f.error /= static_cast<double>(f.pixels);
    SCOPED_TRACE(k == 0 ? "full" : "one_mip");
    EXPECT_GT(f.partly, 300u);
    EXPECT_GT(f.lit, 100u);
    EXPECT_GT(f.unlit, 40u);
    EXPECT_NEAR(f.mean, true_mean, 0.02) << "of " << f.pixels;
    EXPECT_LT(f.error, 0.04);
    // Its kernels stay in the face of the cube, so a few pixels at its edges are not exact.
    EXPECT_LE(f.not_lit, k == 0 ? 0u : f.lit / 200) << "of " << f.lit << ", least " << f.least_lit;
    EXPECT_GT(f.least_lit, 0.9);
  }
  EXPECT_LT(found[1].error, found[0].error + 0.01) << "full: " << found[0].error;
  EXPECT_LE(found[1].not_dark, found[0].not_dark + found[0].unlit / 20) << "of " << found[0].unlit;
  std::printf("mean error: full %.4f, one mip %.4f; visibility %.4f and %.4f, by rays %.4f; in umbra %zu, %zu\n",
              found[0].error, found[1].error, found[0].mean, found[1].mean, true_mean, found[0].not_dark,
              found[1].not_dark);
}

TEST_F(GrassShadowFilter, leaves_other_pixels_as_they_are_to_the_bit) {
  for (const char* mode : {"deferred", "monolithic"}) {
    SCOPED_TRACE(mode);
    GrassStage stage({.shadows = true});
    plant(stage);
    stage.set("shadows.mode", mode);
    add_box(stage);
    const GrassPicture picture = grass_picture(stage, view);
    const std::vector<float> full = light(stage, "full"), other = light(stage, "one_mip");
    std::size_t others = 0, other_changes = 0, grass_changes = 0;
    for (std::size_t i = 0; i < picture.with.depth.size(); ++i) {
      bool changes = false;
      for (std::size_t c = 0; c < 3; ++c) changes = changes || full[4 * i + c] != other[4 * i + c];
      others += picture.is_grass(i) ? 0 : 1;
      (picture.is_grass(i) ? grass_changes : other_changes) += changes ? 1 : 0;
    }
    EXPECT_GT(others, 5000u);
    EXPECT_EQ(other_changes, 0u);
    EXPECT_GT(grass_changes, 50u) << "the filter is not used";
  }
}

// Tiles that classification finds lit or unlit are not filtered, so a few pixels may differ.
TEST_F(GrassShadowFilter, deferred_and_monolithic_shadows_agree) {
  GrassStage stage({.shadows = true});
  plant(stage);
  add_box(stage);
  stage.set("grass.cast_distance", "6");
  const std::vector<float> deferred = light(stage, "one_mip");
  stage.set("shadows.mode", "monolithic");
  const std::vector<float> monolithic = light(stage, "one_mip");
  double brightest = 0.0;
  for (const float value : deferred) brightest = std::max(brightest, double{value});
  std::size_t different = 0;
  for (std::size_t i = 0; i < deferred.size(); ++i)
    different += std::abs(double{deferred[i]} - double{monolithic[i]}) > brightest / 255.0 ? 1 : 0;
  EXPECT_LE(different, deferred.size() / 1000) << "of " << deferred.size();
}

TEST_F(GrassShadowFilter, hard_lamps_and_cut_off_cameras_give_finite_light) {
  for (const double width : {0.0, 1e-6, 3.0}) {
    GrassStage stage({.shadows = true});
    plant(stage, width);
    add_box(stage);
    stage.set("grass.cast_distance", "6");
    for (const float value : light(stage, "one_mip")) ASSERT_TRUE(std::isfinite(value)) << width;
  }
}

TEST_F(GrassShadowFilter, blades_that_rest_draw_no_maps_and_leave_the_picture_to_the_bit) {
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.set("grass.cast_distance", "6");
  stage.set("grass.shadow_turns", "1");
  stage.run_at(1.0 / 60.0);
  const auto drawn = [&] {
    stage.draw(view);
    return stage.renderer->report().counters.at("shadows.faces_drawn");
  };
  int frames = 0;
  while (frames < 900 && drawn() > 0.0) ++frames;
  EXPECT_GT(frames, 30) << "blades bend under their weight first";
  ASSERT_LT(frames, 900);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(drawn(), 0.0) << i;
  const std::vector<float> kept = stage.linear().rgba;
  // Another bias draws all maps anew, and back.
  stage.set("shadows.mip_operator", "nearest");
  stage.draw(view, 2);
  stage.set("shadows.mip_operator", "coverage");
  EXPECT_GT(drawn(), 0.0);
  EXPECT_EQ(differences(kept, stage.linear().rgba), 0u);
  stage.set("lighting.antialiasing", "taa");
  stage.draw(view, 16);
  std::vector<float> before = stage.linear().rgba;
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(drawn(), 0.0) << i;
    const std::vector<float> after = stage.linear().rgba;
    EXPECT_GT(differences(before, after), 0u) << "other points of the pixels";
    before = after;
  }
  stage.wind(vec3(4.0f, 0.0f, 0.0f), 0.3f);
  stage.draw(view, 3);
  EXPECT_GT(drawn(), 0.0) << "the wind blows";
}

TEST_F(GrassShadowFilter, of_few_turns_draws_fewer_faces_in_each_frame_and_all_in_turn) {
  GrassStage stage({.shadows = true});
  plant(stage);
  stage.set("grass.cast_distance", "6");
  stage.wind(vec3(4.0f, 0.0f, 0.0f), 0.3f);
  stage.run_at(1.0 / 60.0);
  const auto mean_drawn = [&](const char* turns) {
    stage.set("grass.shadow_turns", turns);
    stage.draw(view, 4);
    double faces = 0.0, waiting = 0.0;
    for (int i = 0; i < 8; ++i) {
      stage.draw(view);
      faces += stage.renderer->report().counters.at("shadows.faces_drawn");
      waiting += stage.renderer->report().counters.at("shadows.faces_in_turn");
    }
    EXPECT_EQ(waiting > 0.0, std::string(turns) != "1");
    return faces / 8.0;
  };
  const double every = mean_drawn("1");
  EXPECT_GE(every, 2.0);
  EXPECT_NEAR(mean_drawn("2"), every / 2.0, 0.01);
  EXPECT_NEAR(mean_drawn("4"), every / 4.0, 0.01);
}

}  // namespace
}  // namespace gloam::test
