// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/render/readback/geometry_picture.h"
#include "tests/modules/grass/support/stems.h"
#include "tests/support/scale.h"
#include "tests/support/worse.h"

namespace gloam::test {
namespace {

using GrassFrames = GrassTest;

/// Wide blades, so that some pixels lie inside them.
GrassSurface wide() {
  GrassSurface values;
  values.width_m = 0.03f;
  return values;
}

/// Knots and light of some frames in wind.
struct Shown {
  LiveKnots knots;
  std::vector<float> light;
  bool operator==(const Shown&) const = default;
};

Shown show(GrassStage& stage, const ViewSettings& view, int frames, bool wait = true) {
  stage.lawn(0.6f, 700);
  stage.wind(vec3(4.0f, 0.0f, 1.0f), 0.8f);
  stage.run_at(1.0 / 60.0);
  Shown shown;
  for (int i = 0; i < frames; ++i) {
    if (wait) {
      stage.draw(view);
    } else {
      EXPECT_TRUE(stage.try_draw(std::span(&view, 1)).ok());
    }
  }
  shown.knots = stage.copy(view.id).live_knots(stage.field());
  shown.light = stage.linear().rgba;
  return shown;
}

TEST_F(GrassFrames, at_rest_masters_have_the_shape_of_their_type) {
  GrassStage stage;
  stage.set("grass.masters", "1:1");
  stage.set("grass.lod_pixels", "0");
  stage.lawn(0.6f, 500);
  stage.draw(front());
  const GrassCopy copy = stage.copy();
  double worst = 0.0;
  const LiveKnots found = copy.live_knots(stage.field());
  for (const auto& [master, knots] : found) {
    const GrassBlade& blade = stage.field().blades[master];
    const BladeModel model = blade_model(blade, stage.field().types);
    for (std::size_t k = 0; k < kGrassKnots; ++k)
      worst = worse(worst, glm::length(dvec3(knots[k]) - dvec3(blade.root_m) - model.rest[k]));
  }
  EXPECT_EQ(found.size(), 500u);
  EXPECT_LT(worst, 0.005) << "a row holds the yaw to 1/256 turn";
}

TEST_F(GrassFrames, blades_are_drawn_where_their_stems_are_and_nowhere_else) {
  using Variant = std::pair<const char*, bool>;
  for (const auto& [masters, moving] : some_of<Variant>(
           {{"1:1", false}, {"1:1", true}, {"1:4", false}, {"1:4", true}, {"1:16", false}, {"1:16", true}})) {
    SCOPED_TRACE(std::string(masters) + (moving ? " in wind" : " at rest"));
    GrassStage stage;
    stage.set("grass.masters", masters);
    stage.set("grass.lod_pixels", "0");
    stage.set("grass.segments", "full");
    stage.lawn(0.6f, 250, dvec3(0.0), wide());
    if (moving) {
      stage.wind(vec3(6.0f, 0.0f, 2.0f), 0.5f);
      stage.run_at(1.0 / 60.0);
      stage.draw(front(), 20);
      stage.run_at(0.0);
    }
    const GrassPicture picture = grass_picture(stage, front());
    const std::vector<Stem> stems = stems_of(stage.field(), stage.copy(), picture.with.view.position);
    EXPECT_GT(stems.size(), 200u);
    expect_grass_on_stems(picture, stems);
    const MissedPixels pixels = missed_pixels(picture, stems);
    EXPECT_GT(pixels.covered, 400u);
    EXPECT_EQ(pixels.missed, 0u) << "of " << pixels.covered;
  }
}

TEST_F(GrassFrames, blades_with_fewer_segments_stay_near_their_stems) {
  GrassStage stage;
  stage.lawn(2.0f, 3000);
  ViewSettings view = look_at(dvec3(0.0, 1.2, 5.0), dvec3(0.0, 0.1, 0.0), 96, 64);
  const GrassPicture picture = grass_picture(stage, view);
  const GrassCopy copy = stage.copy();
  EXPECT_LT(copy.draws.class_count[0], copy.draws.live);
  const std::vector<Stem> stems = stems_of(stage.field(), copy, picture.with.view.position);
  EXPECT_GT(picture.grass_pixels(), 300u);
  // A blade is widened to about a pixel here, at most 16 times.
  const double pixel_m = static_cast<double>(copy.lod.pixel_m) * 7.0;
  expect_grass_on_stems(picture, stems, 1.0, pixel_m + 0.03);
}

// Hard case: grass.repeatable, grass.threads
TEST_F(GrassFrames, pictures_repeat_for_every_number_of_threads_and_without_waiting) {
  Shown first;
  {
    GrassStage stage;
    first = show(stage, front(), 6);
  }
  EXPECT_GT(first.knots.size(), 1u);
  for (const std::uint32_t threads : some_of<std::uint32_t>({2, 1, 5})) {
    GrassStage stage({.executor = make_pool_executor(threads)});
    EXPECT_TRUE(show(stage, front(), 6) == first) << threads << " threads";
  }
  GrassStage shuffled({.executor = make_shuffled_executor(9)});
  EXPECT_TRUE(show(shuffled, front(), 6) == first) << "jobs in another order";
  GrassStage hasty;
  EXPECT_TRUE(show(hasty, front(), 6, false) == first) << "several frames in flight";
}

TEST_F(GrassFrames, workgroups_of_any_size_simulate_the_same) {
  Shown first;
  for (const char* group : {"64", "32", "128"}) {
    GrassStage stage;
    stage.set("grass.group", group);
    const Shown shown = show(stage, front(), 4);
    if (first.light.empty()) first = shown;
    EXPECT_TRUE(shown == first) << group;
  }
}

TEST_F(GrassFrames, a_collider_pushes_the_blades_out) {
  for (const dvec3& at : some_of<dvec3>({dvec3(0.0), dvec3(102400.0, 0.0, -102400.0)})) {
    const dvec3 center = at + dvec3(0.0, 0.22, 0.0);
    std::size_t inside[2] = {};
    for (const int with : {0, 1}) {
      GrassStage stage;
      stage.set("grass.masters", "1:1");
      stage.set("grass.lod_pixels", "0");
      stage.lawn(0.5f, 250, at);
      if (with == 1)
        stage.world.create(Collider{ColliderShape::sphere, 0.15f, 1.8f, vec3(1.0f)},
                           WorldTransform{glm::translate(dmat4(1.0), center)});
      stage.run_at(1.0 / 60.0);
      stage.draw(front(at), 12);
      for (const Stem& stem : stems_of(stage.field(), stage.copy(), at))
        for (const dvec3& knot : stem.at) inside[with] += glm::length(knot - center) < 0.14 ? 1 : 0;
    }
    EXPECT_GT(inside[0], 80u);
    EXPECT_LT(inside[1], inside[0] / 10);
  }
}

TEST_F(GrassFrames, thinning_keeps_the_coverage) {
  // Seen from above, so that few blades hide others. Blades of 6 mm are narrower than a pixel.
  GrassStage stage;
  stage.lawn(3.0f, 2500);
  const ViewSettings view = look_at({0.0, 4.0, 0.01}, {0.0, 0.0, 0.0}, 192, 128);
  const auto covered = [&](const char* pixels) {
    stage.set("grass.lod_pixels", pixels);
    return static_cast<double>(grass_picture(stage, view).grass_pixels());
  };
  const double all = covered("0");
  const auto blades = stage.copy().draws.live;
  EXPECT_GT(all, 600.0);
  for (const char* pixels : {"0.3", "0.6"}) {
    EXPECT_NEAR(covered(pixels) / all, 1.0, 0.1) << pixels << " pixels";
    EXPECT_LT(stage.copy().draws.live, blades);
  }
}

TEST_F(GrassFrames, nothing_pops_while_the_camera_draws_back) {
  // Per step of 1 % of the distance, the covered pixels change about as much as they do without thinning.
  GrassStage stage;
  GrassSurface values;
  values.max_distance_m = 12.0f;
  stage.lawn(1.5f, 1500, dvec3(0.0), values);
  std::vector<double> counts[2];
  const int steps = std::max(scaled(20), 2);
  for (int step = 0; step < steps; ++step) {
    const double distance_m = 4.0 * std::pow(1.01, step);
    ViewSettings view = look_at({0.0, distance_m, 0.01}, {0.0, 0.0, 0.0}, 192, 128);
    view.camera.fov_y = static_cast<float>(2.0 * std::atan(1.6 / distance_m));
    stage.draw(without_grass(view));
    const GeometryPicture bare = stage.geometry();
    for (const int thinned : {0, 1}) {
      stage.set("grass.lod_pixels", thinned == 1 ? "1" : "0");
      stage.draw(view);
      const GrassPicture picture{stage.geometry(), bare};
      counts[thinned].push_back(static_cast<double>(picture.grass_pixels()));
    }
  }
  for (std::size_t i = 1; i < counts[0].size(); ++i) {
    const double plain = std::abs(counts[0][i] - counts[0][i - 1]), thinned = std::abs(counts[1][i] - counts[1][i - 1]);
    EXPECT_LT(thinned, plain + 0.06 * counts[1][i]) << "step " << i;
  }
}

// Hard case: grass.blades_1, grass.blades_3, grass.blades_4, grass.blades_5, grass.not_64
TEST_F(GrassFrames, few_blades_are_all_drawn) {
  for (const std::uint32_t count : some_of<std::uint32_t>({1, 3, 4, 5, 64, 65, 255, 257})) {
    SCOPED_TRACE(count);
    GrassStage stage;
    stage.set("grass.lod_pixels", "0");
    stage.set("grass.segments", "full");
    GrassSurface values = wide();
    values.seed = count == 5 ? 2 : 1;  // seen face-on
    stage.lawn(0.25f, count, dvec3(0.0), values);
    const GrassPicture picture = grass_picture(stage, front());
    const GrassCopy copy = stage.copy();
    EXPECT_EQ(stage.field().statistics.blades, count);
    EXPECT_EQ(copy.draws.live, count);
    const std::vector<Stem> stems = stems_of(stage.field(), copy, picture.with.view.position);
    EXPECT_GT(picture.grass_pixels(), 0u);
    expect_grass_on_stems(picture, stems);
    EXPECT_EQ(missed_pixels(picture, stems).missed, 0u);
  }
}

// Hard case: grass.threshold_0, grass.threshold_most
TEST_F(GrassFrames, thresholds_leave_out_the_far_blades) {
  GrassStage stage;
  GrassSurface values = wide();
  values.max_distance_m = 4.0f;
  stage.set("grass.lod_pixels", "0");
  stage.lawn(0.6f, 300, dvec3(0.0), values);
  for (const auto& [threshold, least_m, most_m] :
       {std::tuple{"254", 0.0, 4.0}, {"80", 0.0, 81.0 * 4.0 / 255.0}, {"0", 0.0, 4.0 / 255.0}}) {
    stage.set("grass.threshold", threshold);
    const GrassPicture picture = grass_picture(stage, front());
    const GrassCopy copy = stage.copy();
    const std::vector<Stem> stems = stems_of(stage.field(), copy, picture.with.view.position);
    for (const Stem& stem : stems) {
      EXPECT_LE(stem.distance_m, most_m + 1e-3) << threshold;
      EXPECT_GE(stem.distance_m, least_m);
    }
    expect_grass_on_stems(picture, stems, 1.0, 0.03);
    EXPECT_EQ(picture.grass_pixels() == 0, std::string(threshold) == "0") << threshold;
    EXPECT_EQ(stems.empty(), std::string(threshold) == "0") << threshold;
  }
}

// Hard case: grass.camera_inside, grass.all_culled
TEST_F(GrassFrames, a_camera_inside_a_blade_and_one_that_looks_away_draw_numbers) {
  GrassStage stage;
  stage.lawn(0.6f, 700);
  stage.wind(vec3(3.0f, 0.0f, 0.0f), 0.5f);
  stage.run_at(1.0 / 60.0);
  stage.draw(front());
  const std::vector<Stem> stems = stems_of(stage.field(), stage.copy(), dvec3(0.0));
  std::vector<ViewSettings> cameras;
  for (const std::size_t k : {std::size_t{0}, std::size_t{7}, kGrassKnots - 1}) {
    const dvec3 at = stems[stems.size() / 2].at[k];
    cameras.push_back(look_at(at, at + dvec3(0.0, -0.2, -1.0), 48, 32));
    cameras.push_back(look_at(at, at + dvec3(0.01, -1.0, 0.0), 48, 32));
  }
  cameras.push_back(look_at({0.0, 0.5, 1.0}, {0.0, 3.0, 4.0}, 48, 32));    // looks away, near
  cameras.push_back(look_at({0.0, 0.5, 20.0}, {0.0, 3.0, 40.0}, 48, 32));  // looks away, beyond the cast distance
  cameras.push_back(look_at({0.0, -0.5, 1.0}, {0.0, 0.0, 0.0}, 48, 32));   // from below
  cameras.push_back(look_at({0.0, 0.1, 100000.0}, {0.0, 0.0, 0.0}, 48, 32));
  cameras.push_back(front());
  cameras.back().camera.orthographic = true;
  cameras.back().camera.half_height_m = 0.7f;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    stage.draw(cameras[i]);
    for (const float light : stage.linear().rgba) ASSERT_TRUE(std::isfinite(light) && light >= 0.0f) << "camera " << i;
  }
  const GrassPicture from_far = grass_picture(stage, cameras[cameras.size() - 2]);
  EXPECT_EQ(from_far.grass_pixels(), 0u);
  EXPECT_FALSE(stage.has_grass());
}

TEST_F(GrassFrames, an_orthographic_view_shows_the_blades) {
  GrassStage stage;
  stage.set("grass.lod_pixels", "0");
  stage.lawn(0.6f, 250, dvec3(0.0), wide());
  ViewSettings view = front();
  view.camera.orthographic = true;
  view.camera.half_height_m = 0.6f;
  const GrassPicture picture = grass_picture(stage, view);
  EXPECT_GT(picture.grass_pixels(), 500u);
  expect_grass_on_stems(picture, stems_of(stage.field(), stage.copy(), picture.with.view.position));
}

// Hard case: grass.at_100_km
TEST_F(GrassFrames, a_scene_at_any_place_looks_and_moves_like_one_at_the_origin) {
  // No move is a multiple of a texel, of a step of the LOD or of the wind's period.
  const std::vector<dvec3> places = {dvec3(0.0), dvec3(10.0, 0.0, 0.0), dvec3(-3.37, 1.11, 123.4),
                                     dvec3(102345.6, 51200.3, -98765.4), dvec3(1e6, 0.0, 7e5)};
  LiveKnots knots_at_origin;
  std::vector<float> light_at_origin;
  for (const dvec3& at : places) {
    SCOPED_TRACE(at.x);
    GrassStage stage({.shadows = true});
    GrassSurface values;
    values.width_m = 0.012f;
    stage.lawn(0.6f, 300, at, values);
    stage.wind(vec3(5.0f, 0.0f, 1.0f), 0.7f, at);
    stage.sun(dvec3(-0.5, -1.0, -0.3));
    stage.run_at(1.0 / 60.0);
    stage.draw(front(at), scaled(30));
    const LiveKnots knots = stage.copy().live_knots(stage.field());
    const std::vector<float> light = stage.linear().rgba;
    if (light_at_origin.empty()) {
      knots_at_origin = knots;
      light_at_origin = light;
      stage.set("grass.cast_distance", "0");
      stage.draw(front(at));
      EXPECT_GT(differences(stage.linear().rgba, light), light.size() / 20) << "blades cast no shadows";
    }
    EXPECT_EQ(knots.size(), knots_at_origin.size());
    EXPECT_LT(knot_distance(knots, knots_at_origin), 1e-5) << "metres";
    std::size_t different = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
      different += std::abs(light[i] - light_at_origin[i]) > 0.1f * std::max(light[i], light_at_origin[i]) ? 1 : 0;
    EXPECT_LE(different, light.size() / 1000) << "numbers of the picture";
  }
}

// Hard case: grass.dt_0, grass.dt_1us, grass.dt_1s, grass.dt_10s, grass.dt_nan, further.dt_10
TEST_F(GrassFrames, a_long_and_a_broken_frame_leave_the_field_whole) {
  GrassStage stage;
  stage.set("grass.lod_pixels", "0");
  stage.set("grass.segments", "full");
  stage.lawn(0.6f, 250, dvec3(0.0), wide());
  stage.wind(vec3(1000.0f, 0.0f, 0.0f), 1.0f);
  for (const double dt : {1e-6, 1.0, 10.0, std::nan(""), -1.0, 0.0, 1.0 / 60.0}) {
    SCOPED_TRACE(dt);
    stage.run_at(dt);
    stage.draw(front());
    for (const auto& [master, knots] : stage.copy().live_knots(stage.field()))
      for (const vec4& knot : knots) ASSERT_TRUE(std::isfinite(knot.x + knot.y + knot.z));
  }
  stage.run_at(0.0);
  const GrassPicture picture = grass_picture(stage, front());
  EXPECT_GT(picture.grass_pixels(), 100u);
  expect_grass_on_stems(picture, stems_of(stage.field(), stage.copy(), picture.with.view.position));
}

}  // namespace
}  // namespace gloam::test
