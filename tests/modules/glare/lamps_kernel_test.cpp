// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "modules/glare/levels.h"
#include "tests/modules/glare/support/glare_kernel.h"

namespace gloam::test {
namespace {

constexpr double kLampLight = 60000.0;

class GlareLamps : public GlareKernelTest {
 protected:
  static GlareInput lamp_at(uvec2 size, glm::dvec2 at_px, std::uint32_t lines) {
    GlareInput in(size);
    in.lines = lines;
    in.add_lamp(at_px, kLampLight);
    return in;
  }
  /// The light that the convolution of the whole picture gives a pixel.
  static double right_at(const GlareInput& in, glm::uvec2 pixel) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < in.size.y; ++y)
      for (std::uint32_t x = 0; x < in.size.x; ++x) {
        const double light = static_cast<double>(in.light[std::size_t{y} * in.size.x + x].x);
        if (light == 0.0) continue;
        for (const GlareGaussian& g : glare_spread()) {
          const double scale = 1.0 / (g.sigma * in.size.y * std::sqrt(2.0));
          const auto share = [&](double apart) {
            return 0.5 * (std::erf((apart + 0.5) * scale) - std::erf((apart - 0.5) * scale));
          };
          sum += light * g.share * share(static_cast<double>(pixel.x) - x) * share(static_cast<double>(pixel.y) - y);
        }
      }
    return sum;
  }
  static double found_at(const std::vector<vec4>& found, const GlareInput& in, glm::uvec2 pixel) {
    return static_cast<double>(found[std::size_t{pixel.y} * in.size.x + pixel.x].x);
  }
};

// Hard case: glare.energy
TEST_F(GlareLamps, lose_no_light_wherever_they_are) {
  const uvec2 size(320, 180);
  for (const std::uint32_t lines : {45u, 90u, 180u})
    for (const glm::dvec2 at : {glm::dvec2(160.0, 90.0), glm::dvec2(161.5, 90.5), glm::dvec2(140.25, 72.75)}) {
      SCOPED_TRACE(std::to_string(at.x) + ", " + std::to_string(at.y) + ", lines " + std::to_string(lines));
      const GlareInput in = lamp_at(size, at, lines);
      // Half floats round by 2^-12 of a value, at each of up to fifteen passes.
      EXPECT_NEAR(energy(run(in)) / energy(right(in)), 1.0, 0.004);
    }
}

// What leaves the picture is lost, as in the convolution; nothing is reflected at the edges.
// Hard case: glare.borders
TEST_F(GlareLamps, at_the_edges_lose_what_leaves_the_picture) {
  const uvec2 size(320, 180);
  for (const std::uint32_t lines : {90u, 180u})
    for (const glm::dvec2 at :
         {glm::dvec2(3.25, 2.5), glm::dvec2(319.5, 179.5), glm::dvec2(100.5, 0.5), glm::dvec2(0.5, 90.75)}) {
      SCOPED_TRACE(std::to_string(at.x) + ", " + std::to_string(at.y) + ", lines " + std::to_string(lines));
      const GlareInput in = lamp_at(size, at, lines);
      EXPECT_LT(energy(right(in)), 0.6 * kLampLight);
      EXPECT_NEAR(energy(run(in)) / energy(right(in)), 1.0, 0.02);
    }
}

/// The largest change of the glow's ratio to the right one in a step, and the largest ratio and its inverse.
struct Flicker {
  double step = 0.0, apart = 0.0;

  void add(const std::vector<double>& before, const std::vector<double>& now) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      apart = std::max({apart, now[i] - 1.0, 1.0 / now[i] - 1.0});
      if (!before.empty()) step = std::max({step, now[i] / before[i] - 1.0, before[i] / now[i] - 1.0});
    }
  }
};

// A lamp of one pixel's size in steps of 1/8 pixel, over more than two cells. Its glow at points one to ten cells away
// must be that of a lamp that moves evenly: neither its brightness nor its place may jump from cell to cell.
// Hard case: glare.moving_lamp
TEST_F(GlareLamps, that_move_through_pixels_do_not_make_their_glow_flicker) {
  for (const std::uint32_t height : {180u, 270u, 360u}) {
    SCOPED_TRACE(height);
    const uvec2 size(height / 2, height);
    const glm::dvec2 start(size / 2u);
    const double cell = height / 90.0;
    Flicker flicker;
    std::vector<double> before;
    for (int step = 0; step <= static_cast<int>(17.0 * cell); ++step) {
      const GlareInput in = lamp_at(size, start + glm::dvec2(step / 8.0, step / 19.0), 90);
      const std::vector<vec4> found = run(in);
      std::vector<double> ratios;
      for (const glm::dvec2 cells : {glm::dvec2(0.0, -4.0), glm::dvec2(1.5, 5.0), glm::dvec2(6.0, 0.0),
                                     glm::dvec2(-5.0, -5.0), glm::dvec2(10.0, 8.0), glm::dvec2(-12.0, 3.0)}) {
        const glm::uvec2 pixel(start + cells * cell);
        ratios.push_back(found_at(found, in, pixel) / right_at(in, pixel));
      }
      flicker.add(before, ratios);
      before = std::move(ratios);
    }
    EXPECT_LT(flicker.step, 0.02);
    EXPECT_LT(flicker.apart, 0.15);
  }
}

// Along an axis and along a diagonal, the glow is that of the convolution within a bound, and from each pixel to the
// next one it changes as there. The largest steps are near the lamp, where the narrowest blurs end.
// Hard case: glare.rings
TEST_F(GlareLamps, have_a_glow_without_rings) {
  for (const std::uint32_t lines : {90u, 180u})
    for (const std::uint32_t down : {0u, 1u}) {
      SCOPED_TRACE(std::to_string(lines) + ", " + std::to_string(down));
      const GlareInput in = lamp_at(uvec2(360, 360), glm::dvec2(180.5, 180.5), lines);
      const std::vector<vec4> found = run(in);
      double before = 0.0;
      for (std::uint32_t x = 180; x < 360; ++x) {
        const glm::uvec2 pixel(x, 180 + down * (x - 180));
        const double ratio = found_at(found, in, pixel) / right_at(in, pixel);
        EXPECT_NEAR(ratio, 1.0, lines == 90 ? 0.25 : 0.2) << x;
        const bool near = x < 194;  // 3.5 standard deviations of the narrowest Gaussian
        if (x > 180) {
          EXPECT_NEAR(ratio / before, 1.0, near ? 0.16 : 0.05) << x;
        }
        before = ratio;
      }
    }
}

// The lamp's size and the distances are shares of the height.
// Hard case: glare.heights
TEST_F(GlareLamps, look_the_same_at_270_540_and_1080_lines) {
  std::vector<double> least;
  for (const std::uint32_t height : {270u, 540u, 1080u}) {
    const double scale = height / 270.0;
    GlareInput in(uvec2(height / 2, height));
    for (std::uint32_t y = 0; y < 3u * height / 270u; ++y)
      for (std::uint32_t x = 0; x < 3u * height / 270u; ++x)
        in.at(61u * height / 270u + x, 130u * height / 270u + y) = vec4(vec3(static_cast<float>(kLampLight)), 1.0f);
    const std::vector<vec4> found = run(in);
    std::vector<double> glows;
    for (const glm::uvec2 at :
         {glm::uvec2(62, 138), glm::uvec2(75, 131), glm::uvec2(30, 100), glm::uvec2(100, 250), glm::uvec2(64, 30)}) {
      // The mean over what one pixel of 270 lines shows.
      const auto side = static_cast<std::uint32_t>(scale);
      double sum = 0.0;
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) sum += found_at(found, in, at * side + glm::uvec2(x, y));
      glows.push_back(sum / (side * side));
    }
    if (least.empty()) least = glows;
    for (std::size_t i = 0; i < glows.size(); ++i)
      EXPECT_NEAR(glows[i] / least[i], 1.0, 0.06) << height << ", point " << i;
  }
}

}  // namespace
}  // namespace gloam::test
