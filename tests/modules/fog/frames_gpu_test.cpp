// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "modules/lighting/outputs.h"
#include "tests/modules/fog/support/fog_stage.h"

namespace gloam::test {
namespace {

constexpr std::pair<const char*, std::uint32_t> kResolutions[] = {{"full", 1}, {"half", 2}, {"quarter", 4}};
constexpr double kRounded = 6e-4;  // mean error that half floats leave
const Fog kFog{0.05f, vec3(0.2f, 0.1f, 0.4f)};

class FogFrames : public FogStageTest {
 protected:
  /// A filled stage, its light and its distances at a size.
  struct Shown {
    FogStage stage;
    LightMap clear;
    std::vector<double> distances;

    explicit Shown(std::uint32_t width = 96, std::uint32_t height = 64) {
      stage.fill();
      stage.view.width = width;
      stage.view.height = height;
      clear = stage.draw_clear();
      distances = stage.distances();
      stage.put(kFog);
    }
    [[nodiscard]] LinearPicture draw(const char* resolution, const char* radius) {
      stage.set("fog.resolution", resolution);
      stage.set("fog.radius", radius);
      return stage.draw();
    }
  };
};

TEST_F(FogFrames, are_those_of_the_twin_with_every_value_of_both_knobs) {
  Shown shown;
  for (const auto& [resolution, divisor] : kResolutions)
    for (const char* radius : {"0.5", "1", "2", "2.5", "3", "4", "6"}) {
      SCOPED_TRACE(std::string(resolution) + ", " + radius);
      const TwinPicture twin = twin_picture(shown.clear, shown.distances, kFog, divisor, std::stod(radius));
      expect_picture(shown.draw(resolution, radius), twin.light, twin.slack);
    }
}

// Hard case: further.size_1x1
TEST_F(FogFrames, are_those_of_the_twin_at_odd_and_least_sizes) {
  for (const auto& [width, height] : {std::pair{127u, 71u}, {1u, 1u}, {3u, 200u}, {201u, 2u}}) {
    Shown shown(width, height);
    for (const auto& [resolution, divisor] : kResolutions) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height) + ", " + resolution);
      const TwinPicture twin = twin_picture(shown.clear, shown.distances, kFog, divisor, 2.5);
      expect_picture(shown.draw(resolution, "2.5"), twin.light, twin.slack);
    }
  }
}

// The mean over all neighbours stands for each of them: the glow is off where the things around a pixel are both nearer
// and farther than it.
TEST_F(FogFrames, are_near_the_integral_of_the_light_along_each_ray) {
  for (const auto& [width, height] : {std::pair{96u, 64u}, {127u, 71u}}) {
    Shown shown(width, height);
    const std::vector<dvec3> exact = oracle_picture(shown.clear, shown.distances, kFog);
    const LinearPicture drawn = shown.draw("full", "6");
    EXPECT_LT(mean_error(drawn, exact), 2e-3);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      // Of all channels together: one ratio stands for the three.
      const double value = static_cast<double>(drawn.rgba[4 * i] + drawn.rgba[4 * i + 1] + drawn.rgba[4 * i + 2]);
      const double wanted = exact[i].r + exact[i].g + exact[i].b;
      ASSERT_GE(value, wanted * (1.0 - 2.0 * kDrawnSteps) - 1e-4) << i;
      ASSERT_LE(value, wanted * 1.3 + 1e-3) << i;
    }
  }
}

TEST_F(FogFrames, are_nearer_to_those_of_the_widest_kernel_at_full_size_with_every_step_of_a_knob) {
  for (const auto& [width, height] : {std::pair{96u, 64u}, {127u, 71u}}) {
    Shown shown(width, height);
    const std::vector<dvec3> exact = twin_picture(shown.clear, shown.distances, kFog, 1, 6.0).light;
    expect_picture(shown.draw("full", "6"), exact);
    double before = 1.0;
    for (const char* resolution : {"quarter", "half", "full"}) {
      const double error = mean_error(shown.draw(resolution, "6"), exact);
      EXPECT_LT(error, before) << resolution;
      before = error;
    }
    before = 1.0;
    for (const char* radius : {"0.5", "1.5", "2.5", "4"}) {
      const double error = mean_error(shown.draw("full", radius), exact);
      EXPECT_LT(error, std::max(before, kRounded)) << radius;
      before = error;
    }
  }
}

TEST_F(FogFrames, leave_the_picture_alone_without_density) {
  FogStage stage;
  stage.fill();
  const LinearPicture clear = stage.draw();
  for (const float density : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    stage.put({density, vec3(9.0f)});
    EXPECT_TRUE(stage.draw().rgba == clear.rgba) << density;
  }
}

TEST_F(FogFrames, leave_no_fog_for_references_once_it_has_gone) {
  FogStage stage;
  stage.fill();
  const auto density = [&] {
    const auto* fog = stage.world.try_resource<HomogeneousFog>();
    return fog == nullptr ? 0.0f : fog->density;
  };
  static_cast<void>(stage.draw());
  EXPECT_EQ(density(), 0.0f);
  for (const bool taken : {true, false}) {
    stage.put(kFog);
    static_cast<void>(stage.draw());
    EXPECT_EQ(density(), kFog.density);
    taken ? stage.take_fog() : stage.put({0.0f, vec3(9.0f)});
    static_cast<void>(stage.draw());
    EXPECT_EQ(density(), 0.0f) << taken;
  }
}

TEST_F(FogFrames, of_captures_have_no_fog) {
  FogStage stage;
  stage.fill();
  stage.view.purpose = ViewPurpose::capture;
  const LinearPicture clear = stage.draw();
  stage.put(kFog);
  EXPECT_TRUE(stage.draw().rgba == clear.rgba);
}

TEST_F(FogFrames, are_equal_to_the_bit_when_they_are_drawn_again) {
  Shown shown;
  const LinearPicture first = shown.draw("quarter", "2.5");
  EXPECT_TRUE(first.rgba == shown.stage.draw().rgba);
  EXPECT_TRUE(first.rgba == Shown().draw("quarter", "2.5").rgba);
}

}  // namespace
}  // namespace gloam::test
