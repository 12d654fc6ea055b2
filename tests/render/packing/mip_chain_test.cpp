// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/mip_chain.h"
#include "engine/math/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace gloam {
namespace {

struct Size {
  std::uint32_t width;
  std::uint32_t height;
};
constexpr Size kSizes[] = {{1, 1}, {2, 2}, {4, 4},  {16, 16}, {1, 7}, {9, 1},
                           {3, 3}, {5, 8}, {17, 6}, {31, 33}, {64, 1}};

std::vector<std::uint8_t> random_texels(Size size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> texels(std::size_t{4} * size.width * size.height);
  for (std::uint8_t& texel : texels) texel = static_cast<std::uint8_t>(random() & 255u);
  return texels;
}

std::vector<std::byte> chain_of(const std::vector<std::uint8_t>& texels, std::uint32_t width, std::uint32_t height,
                                bool srgb) {
  std::vector<std::byte> chain(mip_chain_bytes(width, height));
  build_mip_chain(texels, width, height, srgb, chain);
  return chain;
}

/// One mip of a chain.
struct Level {
  Size size;
  const std::uint8_t* texels;
  [[nodiscard]] double at(std::uint32_t x, std::uint32_t y, std::size_t channel) const {
    x = std::min(x, size.width - 1);
    y = std::min(y, size.height - 1);
    return texels[4 * (std::size_t{y} * size.width + x) + channel] / 255.0;
  }
};

std::vector<Level> levels_of(const std::vector<std::byte>& chain, Size size) {
  std::vector<Level> levels;
  std::size_t at = 0;
  for (std::uint32_t mip = 0; mip < mip_count(size.width, size.height); ++mip) {
    const Size own{std::max(size.width >> mip, 1u), std::max(size.height >> mip, 1u)};
    levels.push_back({own, reinterpret_cast<const std::uint8_t*>(chain.data()) + at});
    at += std::size_t{4} * own.width * own.height;
  }
  EXPECT_EQ(at, chain.size());
  return levels;
}

/// The mean of four texels, in double; colours of sRGB images in linear light.
double halved(const Level& source, std::uint32_t x, std::uint32_t y, std::size_t channel, bool linear_light) {
  double sum = 0.0;
  for (std::uint32_t dy = 0; dy < 2; ++dy) {
    for (std::uint32_t dx = 0; dx < 2; ++dx) {
      const double value = source.at(2 * x + dx, 2 * y + dy, channel);
      sum += linear_light ? srgb_to_linear(value) : value;
    }
  }
  return linear_light ? linear_to_srgb(sum / 4.0) : sum / 4.0;
}

TEST(MipCount, reaches_one_texel) {
  EXPECT_EQ(mip_count(1, 1), 1u);
  EXPECT_EQ(mip_count(2, 1), 2u);
  EXPECT_EQ(mip_count(3, 3), 2u);
  EXPECT_EQ(mip_count(4, 3), 3u);
  EXPECT_EQ(mip_count(1, 1024), 11u);
  EXPECT_EQ(mip_count(16384, 16384), 15u);
}

TEST(MipChain, begins_with_the_image_itself_and_ends_with_one_texel) {
  for (const Size size : kSizes) {
    const auto texels = random_texels(size, 3);
    const auto chain = chain_of(texels, size.width, size.height, true);
    const auto levels = levels_of(chain, size);
    EXPECT_TRUE(std::equal(texels.begin(), texels.end(), levels.front().texels));
    EXPECT_EQ(levels.back().size.width, 1u);
    EXPECT_EQ(levels.back().size.height, 1u);
  }
}

TEST(MipChain, every_texel_is_the_mean_of_the_four_above_it) {
  for (const bool srgb : {false, true}) {
    for (const Size size : kSizes) {
      const auto chain = chain_of(random_texels(size, size.width * 77 + size.height), size.width, size.height, srgb);
      const auto levels = levels_of(chain, size);
      for (std::size_t m = 1; m < levels.size(); ++m) {
        for (std::uint32_t y = 0; y < levels[m].size.height; ++y) {
          for (std::uint32_t x = 0; x < levels[m].size.width; ++x) {
            for (std::size_t c = 0; c < 4; ++c) {
              const bool linear_light = srgb && c < 3;
              const double expected = halved(levels[m - 1], x, y, c, linear_light);
              // Rounding to 8 bits takes half a step; the table of linear light may take as much again.
              const double bound = (linear_light ? 1.0 : 0.5001) / 255.0;
              ASSERT_NEAR(levels[m].at(x, y, c), expected, bound)
                  << size.width << "x" << size.height << " mip " << m << " at " << x << "," << y << " channel " << c;
            }
          }
        }
      }
    }
  }
}

TEST(MipChain, halves_are_rounded_up_like_everywhere) {
  const std::vector<std::uint8_t> texels = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto chain = chain_of(texels, 2, 2, false);
  EXPECT_EQ(static_cast<int>(chain.back()), 1);
}

TEST(MipChain, an_even_colour_stays_as_it_is) {
  for (const bool srgb : {false, true}) {
    for (int value = 0; value < 256; ++value) {
      const std::vector<std::uint8_t> texels(std::size_t{4} * 5 * 4, static_cast<std::uint8_t>(value));
      const auto chain = chain_of(texels, 5, 4, srgb);
      for (const std::byte byte : chain) ASSERT_EQ(static_cast<int>(byte), value) << (srgb ? "srgb" : "linear");
    }
  }
}

TEST(MipChain, black_and_white_mix_to_the_grey_of_half_the_light) {
  std::vector<std::uint8_t> texels(16, 0);
  for (std::size_t i = 0; i < 8; ++i) texels[i] = 255;  // upper row white
  const auto in_light = chain_of(texels, 2, 2, true);
  EXPECT_EQ(static_cast<int>(in_light[16]), 188);
  EXPECT_EQ(static_cast<int>(in_light[19]), 128) << "alpha is no colour";
  const auto in_numbers = chain_of(texels, 2, 2, false);
  EXPECT_EQ(static_cast<int>(in_numbers[16]), 128);
}

}  // namespace
}  // namespace gloam
