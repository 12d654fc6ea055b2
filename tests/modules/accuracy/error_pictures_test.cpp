// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/error_pictures.h"

#include <gtest/gtest.h>

#include <random>

namespace gloam {
namespace {

constexpr std::uint32_t kWidth = 150;
constexpr std::uint32_t kHeight = 90;

/// The sum of errors in an area, pixel by pixel.
double sum_in(const std::vector<float>& flip, const PictureArea& area) {
  double sum = 0.0;
  for (std::uint32_t y = area.y; y < area.y + area.height; ++y)
    for (std::uint32_t x = area.x; x < area.x + area.width; ++x) sum += static_cast<double>(flip[y * kWidth + x]);
  return sum;
}

TEST(ErrorPictures, worst_areas_have_the_greatest_sums_and_do_not_overlap) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(0.0f, 1.0f);
  std::vector<float> flip(kWidth * kHeight);
  for (float& error : flip) error = number(random) < 0.02f ? number(random) : 0.0f;
  const std::vector<PictureArea> areas = worst_areas(flip, kWidth, kHeight);
  ASSERT_EQ(areas.size(), kWorstAreas);
  double most = 0.0;
  for (std::uint32_t y = 0; y + kWorstHeight <= kHeight; ++y)
    for (std::uint32_t x = 0; x + kWorstWidth <= kWidth; ++x)
      most = std::max(most, sum_in(flip, {x, y, kWorstWidth, kWorstHeight}));
  EXPECT_NEAR(sum_in(flip, areas[0]), most, 1e-9);
  std::vector<int> covered(flip.size());
  for (const PictureArea& area : areas) {
    EXPECT_LE(sum_in(flip, area), most + 1e-9);
    most = sum_in(flip, area);
    for (std::uint32_t y = area.y; y < area.y + area.height; ++y)
      for (std::uint32_t x = area.x; x < area.x + area.width; ++x) EXPECT_EQ(++covered[y * kWidth + x], 1);
  }
}

TEST(ErrorPictures, one_wrong_pixel_gives_one_area_with_it_and_none_gives_none) {
  std::vector<float> flip(kWidth * kHeight);
  EXPECT_TRUE(worst_areas(flip, kWidth, kHeight).empty());
  flip.back() = 0.5f;
  const std::vector<PictureArea> areas = worst_areas(flip, kWidth, kHeight);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_EQ(areas[0], (PictureArea{kWidth - kWorstWidth, kHeight - kWorstHeight, kWorstWidth, kWorstHeight}));
}

TEST(ErrorPictures, areas_of_small_pictures_are_the_picture) {
  const std::vector<float> flip(12, 0.1f);
  EXPECT_EQ(worst_areas(flip, 4, 3), (std::vector<PictureArea>{{0, 0, 4, 3}}));
}

TEST(ErrorPictures, heat_maps_get_lighter_with_the_error) {
  std::vector<float> flip;
  for (int i = 0; i <= 100; ++i) flip.push_back(static_cast<float>(i) / 100.0f);
  const Picture map = heat_map(flip, 101, 1);
  ASSERT_EQ(map.rgba.size(), 404u);
  double before = -1.0;
  for (std::size_t i = 0; i < 101; ++i) {
    const double luma = 0.2126 * map.rgba[4 * i] + 0.7152 * map.rgba[4 * i + 1] + 0.0722 * map.rgba[4 * i + 2];
    EXPECT_GT(luma, before) << i;
    before = luma;
  }
  EXPECT_EQ(map.rgba[0] + map.rgba[1] + map.rgba[2], 0);
}

TEST(ErrorPictures, areas_stand_beside_the_reference) {
  Picture picture = {4, 2, {}};
  Picture reference = {4, 2, {}};
  for (std::uint8_t i = 0; i < 32; ++i) {
    picture.rgba.push_back(i);
    reference.rgba.push_back(static_cast<std::uint8_t>(100 + i));
  }
  const std::vector<PictureArea> areas = {{2, 0, 2, 1}, {1, 1, 2, 1}};
  const Picture both = side_by_side(picture, reference, areas);
  ASSERT_EQ(both.width, 6u);
  ASSERT_EQ(both.height, 4u);
  EXPECT_EQ(both.rgba[0], 8) << "the picture's pixel (2, 0)";
  EXPECT_EQ(both.rgba[4 * 4], 108) << "the reference's";
  EXPECT_EQ(both.rgba[4 * 6 * 3], 20) << "the picture's pixel (1, 1), below a gap of two rows";
  EXPECT_EQ(both.rgba[4 * (6 * 3 + 5)], 124) << "the reference's pixel (2, 1)";
}

}  // namespace
}  // namespace gloam
