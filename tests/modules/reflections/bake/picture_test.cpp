// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/math/packing.h"

namespace gloam {
namespace {

TEST(CapturedPicture, resampling_to_fewer_texels_keeps_the_mean_and_covers_each_texel_once) {
  CapturedPicture picture{10, 7, {}};
  for (int i = 0; i < 70; ++i) picture.texels.emplace_back(static_cast<float>(i * i % 23), 1.0f, 2.0f, 0.5f);
  const CapturedPicture small = resampled(picture, 4);
  // A texel's mean by 840 x 840 points, a common multiple of both grids.
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      double sum = 0.0;
      for (int py = 0; py < 70; ++py)
        for (int px = 0; px < 70; ++px) {
          const int source_x = (x * 70 + px) * 10 / 280, source_y = (y * 70 + py) * 7 / 280;
          sum += static_cast<double>(picture.texels[static_cast<std::size_t>(source_y * 10 + source_x)].x);
        }
      EXPECT_NEAR(small.texels[static_cast<std::size_t>(y * 4 + x)].x, sum / 4900.0, 1e-4);
    }
}

TEST(CapturedPicture, resampling_to_more_texels_interpolates) {
  const CapturedPicture picture{2, 1, {vec4(0.0f), vec4(8.0f)}};
  const CapturedPicture large = resampled(picture, 4);
  const float expected[] = {0.0f, 2.0f, 6.0f, 8.0f};
  for (std::size_t i = 0; i < 16; ++i) EXPECT_FLOAT_EQ(large.texels[i].x, expected[i % 4]);
}

TEST(CapturedPicture, mips_are_means_down_to_one_texel) {
  CapturedPicture picture{4, 4, {}};
  for (int i = 0; i < 16; ++i) picture.texels.emplace_back(static_cast<float>(i));
  std::vector<std::uint16_t> halves;
  append_mip_chain(picture, halves);
  ASSERT_EQ(halves.size(), 4u * (16 + 4 + 1));
  EXPECT_EQ(half_to_float(halves[4 * 16]), (0 + 1 + 4 + 5) / 4.0f);
  EXPECT_EQ(half_to_float(halves[4 * 17]), (2 + 3 + 6 + 7) / 4.0f);
  EXPECT_EQ(half_to_float(halves[4 * 20]), 7.5f);
}

TEST(CapturedPicture, what_is_stored_is_finite_and_not_negative) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(storable(vec3(nan, -1.0f, infinity)), vec3(0.0f, 0.0f, 65504.0f));
  EXPECT_EQ(storable(vec3(1.5f, 1e9f, -infinity)), vec3(1.5f, 65504.0f, 0.0f));
}

}  // namespace
}  // namespace gloam
