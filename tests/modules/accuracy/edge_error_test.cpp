// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/edge_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "modules/accuracy/cost/picture_error.h"
#include "tests/modules/accuracy/test_pictures.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using test::EncodedPicture;

EncodedPicture gray(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
  EncodedPicture picture{width, height, {}};
  picture.rgba.assign(std::size_t{width} * height * 4, value);
  return picture;
}

void set(EncodedPicture& picture, std::uint32_t x, std::uint32_t y, std::uint8_t value) {
  for (std::size_t channel = 0; channel < 3; ++channel)
    picture.rgba[(std::size_t{y} * picture.width + x) * 4 + channel] = value;
}

std::string row_text(const std::vector<bool>& near) {
  std::string text;
  for (const bool pixel : near) text += pixel ? '#' : '.';
  return text;
}

/// Black, and white from the column on.
EncodedPicture half_plane(std::uint32_t width, std::uint32_t height, std::uint32_t column) {
  EncodedPicture picture = gray(width, height, 0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = column; x < width; ++x) set(picture, x, y, 255);
  return picture;
}

TEST(near_edges, are_two_pixels_to_each_side_of_an_edge) {
  EXPECT_EQ(row_text(near_edges(half_plane(10, 1, 4).pixels())), "..####....");
  EXPECT_EQ(row_text(near_edges(half_plane(1, 1, 1).pixels())), ".");
  EncodedPicture column = gray(1, 10, 0);
  for (std::uint32_t y = 4; y < 10; ++y) set(column, 0, y, 255);
  EXPECT_EQ(row_text(near_edges(column.pixels())), "..####....") << "edges between rows, too";
}

TEST(near_edges, stop_at_the_borders_of_the_picture) {
  EXPECT_EQ(row_text(near_edges(half_plane(5, 2, 1).pixels())), "###..###..");
  EXPECT_EQ(row_text(near_edges(half_plane(5, 2, 4).pixels())), "..###..###");
}

TEST(near_edges, are_steps_of_luma_that_antialiasing_would_see) {
  EncodedPicture picture = gray(8, 1, 100);
  set(picture, 4, 0, 112);  // 12 / 255 < 0.05
  EXPECT_EQ(row_text(near_edges(picture.pixels())), "........");
  set(picture, 4, 0, 113);  // 13 / 255 > 0.05
  EXPECT_EQ(row_text(near_edges(picture.pixels())), "..#####.");
}

TEST(edge_error, is_taken_over_the_pixels_near_edges_only) {
  const EncodedPicture reference = half_plane(100, 1, 50);
  EncodedPicture test = reference;
  set(test, 0, 0, 255);  // far from the edge: must not count
  set(test, 49, 0, 51);  // a fifth
  std::vector<float> flip(100, 0.0f);
  flip[0] = 1.0f;
  flip[49] = 0.4f;
  const auto error = edge_error(near_edges(reference.pixels()), flip, reference.pixels(), test.pixels());
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(error->flip.mean, 0.1, 1e-6);
  EXPECT_NEAR(error->flip.p99, 0.4 * 0.97, 1e-6) << "of 4 pixels, linear between the last two";
  EXPECT_NEAR(error->psnr_db, -10.0 * std::log10(0.04 / 4.0), 1e-9);
  EXPECT_NEAR(error->share, 0.04, 1e-12);
  const auto equal = edge_error(near_edges(reference.pixels()), flip, reference.pixels(), reference.pixels());
  EXPECT_TRUE(std::isinf(equal->psnr_db));
}

TEST(edge_error, is_absent_without_edges) {
  const EncodedPicture flat = gray(9, 9, 80);
  const std::vector<float> flip(81, 0.5f);
  EXPECT_FALSE(edge_error(near_edges(flat.pixels()), flip, flat.pixels(), flat.pixels()).has_value());
  EXPECT_ASSERT((void)edge_error(std::vector<bool>(80), flip, flat.pixels(), flat.pixels()), "one value a pixel");
}

/// A slanted edge: the share of each pixel that is white, or its centre's side alone.
Picture slanted(bool smooth) {
  Picture picture = {64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 255)};
  for (std::uint32_t y = 0; y < 64; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const double distance = (x + 0.5) - 20.0 - 0.3 * (y + 0.5);
      const double share = smooth ? std::clamp(distance + 0.5, 0.0, 1.0) : distance > 0.0 ? 1.0 : 0.0;
      for (std::size_t channel = 0; channel < 3; ++channel)
        picture.rgba[(y * 64 + x) * 4 + channel] = static_cast<std::uint8_t>(std::lround(255.0 * share));
    }
  }
  return picture;
}

TEST(edge_error, shows_stairs_that_the_mean_hides) {
  const Picture reference = slanted(true);
  Picture stairs = slanted(false);
  // Far from the edge the stairs are exact; the other picture has the right edge and a soft error elsewhere.
  Picture soft = reference;
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 50; x < 64; ++x)
      for (std::size_t channel = 0; channel < 3; ++channel) soft.rgba[(y * 64 + x) * 4 + channel] = 190;
  const PictureJudge judge({.linear = {}, .picture = reference});
  LedgerRow stairs_row, soft_row;
  ASSERT_TRUE(judge.judge({.linear = {}, .picture = stairs}, stairs_row).ok());
  ASSERT_TRUE(judge.judge({.linear = {}, .picture = soft}, soft_row).ok());
  EXPECT_LT(stairs_row.flip->mean, soft_row.flip->mean) << "by the mean the stairs are better";
  EXPECT_GT(stairs_row.edges->flip.mean, 10.0 * soft_row.edges->flip.mean);
  EXPECT_LT(stairs_row.edges->psnr_db, 25.0);
  EXPECT_LT(stairs_row.edges->share, 0.2);
}

}  // namespace
}  // namespace gloam
