// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "modules/lighting/display/tone_reference.h"

namespace gloam {
namespace {

/// A grey picture of n × n pixels. stops: of each pixel's luminance.
LinearPicture picture_of_stops(std::uint32_t n, const std::function<double(std::uint32_t pixel)>& stops) {
  LinearPicture picture{n, n, {}};
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const auto light = static_cast<float>(std::exp2(stops(i)));
    picture.rgba.insert(picture.rgba.end(), {light, light, light, 1.0f});
  }
  return picture;
}

/// The key of Krawczyk et al. 2005 for the mean of log2 luminance over all pixels. Values are sorted; the darkest tenth
/// and the brightest twentieth are cut off, pixels at the cuts in part.
double exposure_of_sorted(const LinearPicture& p) {
  std::vector<double> values;
  for (std::size_t i = 0; i < p.rgba.size(); i += 4) values.push_back(std::log2(static_cast<double>(p.rgba[i])));
  std::ranges::sort(values);
  const double count = static_cast<double>(values.size()), from = 0.1 * count, to = 0.95 * count;
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double index = static_cast<double>(i);
    sum += values[i] * std::max(std::min(index + 1.0, to) - std::max(index, from), 0.0);
  }
  const double mean = std::exp2(sum / (to - from));
  return (1.03 - 2.0 / (2.0 + std::log10(mean + 1.0))) / mean;
}

double stops_between(double a, double b) { return std::abs(std::log2(a / b)); }

TEST(Exposure, of_an_exposure_value_makes_the_saturation_luminance_white) {
  // Lagarde and de Rousiers 2014: L_max = 1.2 · 2^EV100 cd/m².
  EXPECT_FLOAT_EQ(exposure_from_ev100(0.0f), 1.0f / 1.2f);
  EXPECT_FLOAT_EQ(exposure_from_ev100(15.0f), 1.0f / (1.2f * 32768.0f));
  EXPECT_FLOAT_EQ(exposure_from_ev100(-3.0f), 8.0f / 1.2f);
  for (const float ev : {-100.0f, -50.0f, 50.0f, 100.0f}) {
    EXPECT_GT(exposure_from_ev100(ev), 0.0f);
    EXPECT_TRUE(std::isfinite(exposure_from_ev100(ev)));
  }
}

TEST(Metering, takes_the_mean_of_stops_between_two_percentiles) {
  std::mt19937 random(7);
  std::normal_distribution<double> bell(-2.0, 3.0);
  std::uniform_real_distribution<double> even(-9.0, 6.0);
  const auto lamps = [&](std::uint32_t pixel) { return pixel % 100 == 0 ? 14.0 : -4.0 + 0.01 * (pixel % 32); };
  for (int i = 0; i < 3; ++i) {
    const LinearPicture bells = picture_of_stops(32, [&](std::uint32_t) { return bell(random); });
    EXPECT_LT(stops_between(metered_exposure(bells), exposure_of_sorted(bells)), 0.01);
    const LinearPicture evens = picture_of_stops(32, [&](std::uint32_t) { return even(random); });
    EXPECT_LT(stops_between(metered_exposure(evens), exposure_of_sorted(evens)), 0.01);
  }
  const LinearPicture lit = picture_of_stops(32, lamps);
  EXPECT_LT(stops_between(metered_exposure(lit), exposure_of_sorted(lit)), 0.05);
}

TEST(Metering, is_not_moved_by_a_few_lamps_or_black_corners) {
  const auto wall = [](std::uint32_t pixel) { return -3.0 + 0.02 * (pixel % 32); };
  const double plain = metered_exposure(picture_of_stops(32, wall));
  for (const double stops : {8.0, 16.0}) {
    const auto lamps = [&](std::uint32_t pixel) { return pixel % 25 == 0 ? stops : wall(pixel); };
    EXPECT_LT(stops_between(metered_exposure(picture_of_stops(32, lamps)), plain), 0.1) << stops;
    const auto dark = [&](std::uint32_t pixel) { return pixel % 12 == 0 ? -stops : wall(pixel); };
    EXPECT_LT(stops_between(metered_exposure(picture_of_stops(32, dark)), plain), 0.1) << stops;
  }
}

TEST(Metering, follows_light_without_steps) {
  // A bin is a quarter of a stop. Light that rises by a sixteenth of it never moves the exposure back or by more than
  // two sixteenths, although all pixels leave a bin together.
  double last = metered_exposure(picture_of_stops(32, [](std::uint32_t) { return -6.0; }));
  for (int i = 1; i <= 64; ++i) {
    const double now = metered_exposure(picture_of_stops(32, [&](std::uint32_t) { return -6.0 + i / 64.0; }));
    EXPECT_GT(std::log2(last / now), 0.25 / 64.0) << i;
    EXPECT_LT(std::log2(last / now), 2.0 / 64.0) << i;
    last = now;
  }
}

}  // namespace
}  // namespace gloam
