// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/linear_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/modules/accuracy/test_pictures.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using test::EncodedPicture;
using test::FloatPicture;
using test::random_encoded;
using test::random_linear;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(rms_error, is_the_root_of_the_mean_square_of_every_channel) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{7u, 3u}, std::pair{40u, 25u}}) {
    const FloatPicture a = random_linear(width, height, 1);
    const FloatPicture b = random_linear(width, height, 2);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      if (i % 4 != 3) sum += std::pow(double{a.rgba[i]} - double{b.rgba[i]}, 2.0);
    }
    const auto error = rms_error(a.pixels(), b.pixels());
    ASSERT_TRUE(error.ok());
    EXPECT_NEAR(error->rmse, std::sqrt(sum / (3.0 * width * height)), 1e-9);
    ASSERT_EQ(error->map.size(), std::size_t{width} * height);
    double square = 0.0;
    for (int channel = 0; channel < 3; ++channel)
      square += std::pow(double{a.rgba[channel]} - double{b.rgba[channel]}, 2.0);
    EXPECT_NEAR(error->map[0], std::sqrt(square / 3.0), 1e-5);
  }
}

TEST(rms_error, has_a_percentile_that_sees_the_worst_pixels) {
  const FloatPicture a{100, 1, std::vector<float>(400, 1.0f)};
  FloatPicture b = a;
  for (int pixel = 0; pixel < 3; ++pixel) b.rgba[pixel * 4] += 9.0f;
  const auto error = rms_error(a.pixels(), b.pixels());
  ASSERT_TRUE(error.ok());
  EXPECT_NEAR(error->pixels.p99, 9.0 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(error->pixels.mean, 0.03 * 9.0 / std::sqrt(3.0), 1e-6);
}

TEST(rms_error, of_the_same_picture_is_nothing) {
  const FloatPicture a = random_linear(5, 7, 1);
  const auto error = rms_error(a.pixels(), a.pixels());
  ASSERT_TRUE(error.ok());
  EXPECT_EQ(error->rmse, 0.0);
}

TEST(rms_error, names_the_pixel_that_is_not_a_number) {
  const FloatPicture a = random_linear(5, 4, 1);
  FloatPicture b = a;
  b.rgba[(2 * 5 + 3) * 4 + 1] = kNan;
  const auto test = rms_error(a.pixels(), b.pixels());
  ASSERT_FALSE(test.ok());
  EXPECT_EQ(test.error().kind, ErrorKind::failed);
  EXPECT_THAT(test.error().message, HasSubstr("the picture cannot be judged: pixel 3,2 is not a finite number"));
  const auto reference = rms_error(b.pixels(), a.pixels());
  ASSERT_FALSE(reference.ok());
  EXPECT_THAT(reference.error().message, HasSubstr("the reference cannot be judged"));
  b.rgba[(2 * 5 + 3) * 4 + 1] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(rms_error(a.pixels(), b.pixels()).ok());
  // Opacity is ignored.
  FloatPicture c = a;
  c.rgba[3] = kNan;
  EXPECT_TRUE(rms_error(a.pixels(), c.pixels()).ok());
}

TEST(rms_error, rejects_pictures_that_cannot_be_compared) {
  const FloatPicture a = random_linear(4, 4, 1);
  const FloatPicture b = random_linear(2, 8, 1);
  EXPECT_ASSERT((void)rms_error(a.pixels(), b.pixels()), "different sizes");
  EXPECT_ASSERT((void)rms_error(a.pixels(), LinearPixels{4, 4, {}}), "four numbers a pixel");
}

TEST(psnr, is_ten_logarithms_of_peak_square_over_mean_square) {
  const EncodedPicture a = random_encoded(9, 5, 1);
  const EncodedPicture b = random_encoded(9, 5, 2);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 != 3) sum += std::pow(double{1.0} * a.rgba[i] - b.rgba[i], 2.0);
  }
  EXPECT_NEAR(psnr_db(a.pixels(), b.pixels()), 10.0 * std::log10(255.0 * 255.0 / (sum / (3.0 * 45.0))), 1e-9);
}

TEST(psnr, of_the_same_picture_is_infinite) {
  const EncodedPicture a = random_encoded(1, 1, 1);
  EXPECT_EQ(psnr_db(a.pixels(), a.pixels()), std::numeric_limits<double>::infinity());
}

TEST(temporal_error, sees_only_change_that_the_reference_does_not_have) {
  std::vector<FloatPicture> reference;
  std::vector<FloatPicture> steady;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    reference.push_back(random_linear(6, 3, frame));
    steady.push_back(reference.back());
    for (float& value : steady.back().rgba) value += 5.0f;  // wrong, but the same in every frame
  }
  std::vector<FloatPicture> flickering = reference;
  for (float& value : flickering[2].rgba) value += 3.0f;
  const auto pixels = [](const std::vector<FloatPicture>& frames) {
    std::vector<LinearPixels> result;
    for (const FloatPicture& frame : frames) result.push_back(frame.pixels());
    return result;
  };
  const auto none = temporal_error(pixels(reference), pixels(steady));
  ASSERT_TRUE(none.ok());
  EXPECT_NEAR(none->max, 0.0, 1e-5);
  const auto flicker = temporal_error(pixels(reference), pixels(flickering));
  ASSERT_TRUE(flicker.ok());
  EXPECT_NEAR(flicker->mean, 2.0, 1e-5);  // two of three changes, each by 3
  EXPECT_NEAR(flicker->p99, 3.0, 1e-5);
}

TEST(temporal_error, agrees_with_its_definition) {
  std::vector<FloatPicture> frames;
  for (std::uint32_t seed = 0; seed < 6; ++seed) frames.push_back(random_linear(5, 5, seed));
  const std::vector<LinearPixels> a = {frames[0].pixels(), frames[1].pixels(), frames[2].pixels()};
  const std::vector<LinearPixels> b = {frames[3].pixels(), frames[4].pixels(), frames[5].pixels()};
  double sum = 0.0;
  for (std::size_t f = 1; f < 3; ++f) {
    for (std::size_t i = 0; i < 25; ++i) {
      double square = 0.0;
      for (std::size_t c = i * 4; c < i * 4 + 3; ++c) {
        const double change = double{b[f].rgba[c]} - double{b[f - 1].rgba[c]};
        square += std::pow(change - (double{a[f].rgba[c]} - double{a[f - 1].rgba[c]}), 2.0);
      }
      sum += std::sqrt(square / 3.0);
    }
  }
  EXPECT_NEAR(temporal_error(a, b)->mean, sum / 50.0, 1e-5);
}

TEST(temporal_error, of_less_than_two_frames_is_nothing) {
  const FloatPicture frame = random_linear(3, 3, 1);
  const LinearPixels one[] = {frame.pixels()};
  EXPECT_EQ(temporal_error(one, one)->max, 0.0);
  EXPECT_EQ(temporal_error({}, {})->max, 0.0);
}

TEST(temporal_error, names_the_frame_that_is_broken) {
  const FloatPicture good = random_linear(3, 3, 1);
  FloatPicture bad = good;
  bad.rgba[0] = kNan;
  const LinearPixels reference[] = {good.pixels(), good.pixels()};
  const LinearPixels test[] = {good.pixels(), bad.pixels()};
  const auto error = temporal_error(reference, test);
  ASSERT_FALSE(error.ok());
  EXPECT_THAT(error.error().message, HasSubstr("frame 1 cannot be judged: pixel 0,0"));
  EXPECT_ASSERT((void)temporal_error(reference, {}), "different lengths");
}

}  // namespace
}  // namespace gloam
