// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/ext/vector_double2.hpp>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/modules/grass/support/stems.h"

#include "engine/render/readback/geometry_picture.h"
#include "engine/scene/units.h"
#include "tests/support/worse.h"

// GeometryOutputs::motion of blades against the stems of two frames, projected in double precision.

namespace gloam::test {
namespace {

using glm::dvec2;

constexpr double kFrame = 1.0 / 60.0;

/// The stems of a frame, by slot of the blade, and the camera that saw them.
struct Seen {
  std::map<std::uint32_t, Stem> stems;
  RenderView view;
};

struct Compared {
  int pixels = 0;
  double worst = 0.0;    ///< difference from the expected motion, pixels
  double mean = 0.0;     ///< of the differences
  double longest = 0.0;  ///< motion of a blade beyond that of the camera, pixels
};

dvec2 pixel_of(const RenderView& view, const dvec3& point) {
  const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(point - view.position, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.width, (0.5 - 0.5 * clip.y / clip.w) * view.height};
}

class GrassMotion : public GrassTest {
 protected:
  [[nodiscard]] static ViewSettings camera(double turn) {
    return look_at({0.1 + turn, 0.45, 1.3 - 0.5 * turn}, {0.4 * turn, 0.12, 0.0}, 192, 128);
  }
  static void blow(GrassStage& stage, const char* masters) {
    GrassSurface values;
    values.width_m = 0.015f;
    stage.set("grass.masters", masters);
    stage.set("grass.lod_pixels", "0");
    stage.set("grass.segments", "full");
    stage.lawn(0.6f, 120, dvec3(0.0), values);
    stage.wind(vec3(40.0f, 0.0f, 15.0f), 0.8f);
    stage.run_at(kFrame);
  }
  [[nodiscard]] static std::vector<vec2> motion_of(GrassStage& stage) {
    static constexpr std::string_view kNames[] = {"motion"};
    const ImageBytes image = value_of(stage.renderer->read_images(stage.world, ViewId{0}, kNames)).front();
    std::vector<vec2> motion(image.bytes.size() / sizeof(vec2));
    std::memcpy(motion.data(), image.bytes.data(), image.bytes.size());
    return motion;
  }
  [[nodiscard]] static Seen seen(GrassStage& stage) {
    Seen frame;
    frame.view = stage.geometry().view;
    for (const Stem& stem : stems_of(stage.field(), stage.copy(), frame.view.position)) frame.stems[stem.slot] = stem;
    return frame;
  }

  /// The difference at one pixel from the motion of the blade there. If several blades are there, of the one that fits
  /// best.
  static void compare_pixel(const Seen& now, const Seen& before, const dvec3& point, const dvec2& pixel,
                            const dvec2& motion, Compared& compared) {
    double best = std::numeric_limits<double>::infinity(), own = 0.0;
    const dvec2 of_camera = pixel - pixel_of(before.view, point);
    for (const auto& [slot, stem] : now.stems) {
      const auto earlier = before.stems.find(slot);
      if (earlier == before.stems.end()) continue;
      for (std::size_t k = 1; k < kGrassKnots; ++k) {
        const dvec3 along = stem.at[k] - stem.at[k - 1];
        const double t = std::clamp(glm::dot(point - stem.at[k - 1], along) / glm::dot(along, along), 0.0, 1.0);
        if (glm::length(point - stem.at[k - 1] - t * along) > 0.5 * stem.width_m + 0.004) continue;
        const dvec3 way =
            (1.0 - t) * (stem.at[k - 1] - earlier->second.at[k - 1]) + t * (stem.at[k] - earlier->second.at[k]);
        const dvec2 expected = pixel - pixel_of(before.view, point - way);
        if (glm::length(motion - expected) >= best) continue;
        best = glm::length(motion - expected);
        own = glm::length(expected - of_camera);
      }
    }
    ASSERT_TRUE(std::isfinite(best)) << "a pixel of grass off all blades";
    ++compared.pixels;
    compared.worst = std::max(compared.worst, best);
    compared.mean += best;
    compared.longest = std::max(compared.longest, own);
  }
  [[nodiscard]] static Compared compare(GrassStage& stage, const Seen& before) {
    const Seen now = seen(stage);
    const GeometryPicture picture = stage.geometry();
    const std::vector<vec2> motion = motion_of(stage);
    Compared compared;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      if (picture.is_sky(i) || !picture.texel(i).subsurface) continue;
      const auto x = static_cast<std::uint32_t>(i % now.view.width), y = static_cast<std::uint32_t>(i / now.view.width);
      compare_pixel(now, before, now.view.position + picture.position(x, y), dvec2(x + 0.5, y + 0.5), dvec2(motion[i]),
                    compared);
    }
    compared.mean /= std::max(compared.pixels, 1);
    std::printf("  %d pixels of grass, own motion up to %.2f pixels, difference %.4f, at most %.4f\n", compared.pixels,
                compared.longest, compared.mean, compared.worst);
    return compared;
  }
};

TEST_F(GrassMotion, of_masters_is_that_of_their_knots) {
  for (const double turn : {0.0, 0.05})
    for (const double dt_s : {kFrame, 1.0 / 120.0, 1.0 / 30.0}) {
      SCOPED_TRACE(std::to_string(turn) + " " + std::to_string(dt_s));
      GrassStage stage({.motion = true});
      blow(stage, "1:1");
      stage.run_at(dt_s);
      stage.draw(camera(0.0), 4);
      const Seen before = seen(stage);
      stage.draw(camera(turn));
      const Compared compared = compare(stage, before);
      EXPECT_GT(compared.pixels, 500);
      EXPECT_GT(compared.longest, 0.2);
      // A blade that is widened to a pixel has the motion of its stem, half a pixel beside it.
      EXPECT_LT(compared.worst, turn > 0.0 ? 0.08 : 0.04);
    }
}

TEST_F(GrassMotion, of_slaves_follows_their_masters) {
  GrassStage stage({.motion = true});
  blow(stage, "1:4");
  stage.draw(camera(0.0), 20);
  const Seen before = seen(stage);
  stage.draw(camera(0.0));
  const Compared compared = compare(stage, before);
  EXPECT_GT(compared.longest, 1.0);
  // The turn of a slave changes with the speed of its master.
  EXPECT_LT(compared.worst, 0.7);
  EXPECT_LT(compared.mean, 0.03);
}

TEST_F(GrassMotion, is_that_in_metres_whatever_a_unit_is) {
  std::vector<vec2> first;
  for (const double units : {1.0, 1.0 / 128.0, 128.0}) {  // of a metre; powers of two, so that nothing is rounded
    GrassStage stage({.motion = true});
    stage.world.set_resource(SceneUnits{1.0 / units});
    stage.set("grass.lod_pixels", "0");
    GrassSurface values;
    values.width_m = 0.015f;
    const Entity ground = stage.lawn(static_cast<float>(0.6 * units), 120, dvec3(0.0), values);
    stage.world.get<GrassSurface>(ground).density = 120.0f / 1.44f;
    stage.wind(vec3(40.0f, 0.0f, 15.0f), 0.8f);
    stage.run_at(kFrame);
    const auto draw = [&](double turn) {
      ViewSettings view = camera(turn);
      view.world_from_camera[3] = dvec4(dvec3(view.world_from_camera[3]) * units, 1.0);
      view.camera.near_m *= static_cast<float>(units);
      stage.world.get<WorldTransform>(ground).matrix[3].x = turn * units;
      stage.draw(view);
    };
    for (int i = 0; i < 4; ++i) draw(0.0);
    draw(0.05);
    const std::vector<vec2> motion = motion_of(stage);
    if (first.empty()) first = motion;
    double worst = 0.0, longest = 0.0;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      worst = worse(worst, static_cast<double>(glm::length(motion[i] - first[i])));
      longest = std::max(longest, static_cast<double>(glm::length(motion[i])));
    }
    EXPECT_GT(longest, 1.0);
    EXPECT_LT(worst, 0.001) << units;
  }
}

// Hard case: further.dt_0
TEST_F(GrassMotion, is_none_while_time_stands_and_in_the_first_frame) {
  GrassStage stage({.motion = true});
  blow(stage, "1:4");
  const auto expect_none = [&](const char* when) {
    for (const vec2& motion : motion_of(stage)) ASSERT_EQ(motion, vec2(0.0f)) << when;
  };
  stage.draw_at(1.0, camera(0.0));
  expect_none("first frame");
  stage.draw_at(1.0 + kFrame, camera(0.0));
  stage.draw_at(1.0 + kFrame, camera(0.0));
  expect_none("time stands");
  stage.draw_at(1.0 + 1.1 * kFrame, camera(0.0));
  stage.run_at(0.1 * kFrame);
  stage.draw_at(1.0 + 1.2 * kFrame, camera(0.0));
  expect_none("a frame without a step");
  stage.run_at(kFrame);
  stage.draw_at(1.0, camera(0.0));
  expect_none("time goes back");
}

}  // namespace
}  // namespace gloam::test
