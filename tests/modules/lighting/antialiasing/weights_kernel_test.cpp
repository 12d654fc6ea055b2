// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/lighting/antialiasing/smoothed_picture.h"

namespace gloam::test {
namespace {

class AntialiasingWeights : public AntialiasingTest {
 protected:
  /// Compares all pixels with the twin. Returns the number of pixels with a share.
  static std::size_t expect_twin(const ShownPicture& picture, const std::string& name) {
    const auto [weights, rectangles] = find_weights(*device(), picture);
    expect_rectangles(picture, weights, rectangles, name);
    const SharesTwin twin(picture);
    std::size_t blended = 0, faults = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const std::uint32_t word = weights[static_cast<std::size_t>(y * picture.width + x)];
        const Shares drawn = unpacked(word), right = twin.shares(x, y);
        blended += word != 0;
        for (std::size_t n = 0; n < 4; ++n)
          if (!(std::abs(drawn[n] - right[n]) < 0.51 / 255.0) && ++faults < 6)
            ADD_FAILURE() << name << " at " << x << ", " << y << ", side " << n << ": " << drawn[n] << " in place of "
                          << right[n];
      }
    EXPECT_EQ(faults, 0u) << name;
    return blended;
  }
  /// The rectangles lie in the picture and do not overlap, and all pixels with a share are in one.
  static void expect_rectangles(const ShownPicture& picture, const std::vector<std::uint32_t>& weights,
                                const std::vector<uvec2>& rectangles, const std::string& name) {
    const uvec2 size(picture.width, picture.height);
    std::vector<int> drawn(weights.size(), 0);
    for (const uvec2& rectangle : rectangles) {
      const uvec2 first(rectangle.x & 0xFFFFu, rectangle.x >> 16);
      const uvec2 end = first + uvec2(rectangle.y & 0xFFFFu, rectangle.y >> 16);
      ASSERT_TRUE(end.x <= size.x && end.y <= size.y) << name;
      ASSERT_TRUE(first.x < end.x && first.y < end.y) << name;
      for (std::uint32_t y = first.y; y < end.y; ++y)
        for (std::uint32_t x = first.x; x < end.x; ++x) ASSERT_EQ(++drawn[y * size.x + x], 1) << name;
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      ASSERT_TRUE(weights[i] == 0 || drawn[i] == 1) << name << ", pixel " << i;
  }
  /// Random blocks of few levels: many short edges and crossings.
  static ShownPicture blocks(int width, int height, std::uint32_t seed, int side) {
    std::mt19937 random(seed);
    std::vector<double> levels;
    for (int i = 0; i < 4096; ++i) levels.push_back(0.25 * static_cast<double>(random() % 5));
    return {width, height,
            [&](int x, int y) { return levels[static_cast<std::size_t>((y / side) * 61 + x / side) % 4096]; }};
  }
  /// A bright half-plane at an angle, behind a dark disc.
  static ShownPicture slanted(int width, int height, double angle) {
    return {width, height, [=](int x, int y) {
              const double u = x + 0.5 - 0.5 * width, v = y + 0.5 - 0.5 * height;
              if (std::hypot(u - 3.0, v) < 0.2 * height) return 0.1;
              return u * std::sin(angle) - v * std::cos(angle) > 0.3 ? 0.8 : 0.3;
            }};
  }
};

TEST_F(AntialiasingWeights, equal_the_twin_at_slanted_edges) {
  std::size_t blended = 0;
  for (const double degrees : {0.5, 2.0, 7.0, 20.0, 40.0, 45.0, 50.0, 75.0, 88.0, 89.4, 100.0, 170.0, 178.5})
    blended += expect_twin(slanted(157, 131, degrees * std::numbers::pi / 180.0), std::to_string(degrees));
  EXPECT_GT(blended, 3000u);
}

TEST_F(AntialiasingWeights, equal_the_twin_in_random_pictures_of_all_sizes) {
  std::size_t blended = 0;
  std::uint32_t seed = 1;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 2}, {1, 40}, {40, 1}, {2, 70}, {31, 33}, {32, 32}, {33, 31}, {64, 65}, {129, 70}})
    for (const int side : {1, 2, 5})
      blended += expect_twin(blocks(width, height, ++seed, side), std::to_string(width) + "x" + std::to_string(height));
  EXPECT_GT(blended, 2000u);
}

TEST_F(AntialiasingWeights, equal_the_twin_along_edges_of_any_length) {
  // Stairs with steps of 1 to 80 pixels, which begin at any bit of a word.
  for (int first = 0; first < 3; ++first)
    for (const bool turned : {false, true}) {
      std::vector<int> step(512);
      int at = 11 * first, row = 0, length = 1;
      for (int& value : step) {
        if (--at < 0) {
          at = length;
          length += 9;
          ++row;
        }
        value = row;
      }
      const auto stair = [&](int x, int y) { return y > 3 + step[static_cast<std::size_t>(x)] ? 0.7 : 0.2; };
      const ShownPicture picture =
          turned ? ShownPicture(17, 330, [&](int x, int y) { return stair(y, x); }) : ShownPicture(330, 17, stair);
      EXPECT_GT(expect_twin(picture, "stair"), 100u);
    }
}

TEST_F(AntialiasingWeights, equal_the_twin_along_lines_of_one_pixel) {
  for (const double slope : {0.02, 0.11, 0.35, 0.8}) {
    const ShownPicture picture(120, 110,
                               [&](int x, int y) { return y == static_cast<int>(4.0 + slope * x) ? 0.9 : 0.05; });
    EXPECT_GT(expect_twin(picture, "line"), 60u) << slope;
  }
}

TEST_F(AntialiasingWeights, equal_the_twin_beside_numbers_that_are_not_finite) {
  ShownPicture picture = slanted(60, 50, 0.3);
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i)
    picture.at(static_cast<int>(random() % 60), static_cast<int>(random() % 50)).w =
        i % 3 == 0 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::uint32_t> weights = antialiasing_weights(*device(), picture);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Shares shares = unpacked(weights[static_cast<std::size_t>(y * picture.width + x)]);
      const double sides[] = {picture.at(x, std::max(y - 1, 0)).w, picture.at(x, std::min(y + 1, picture.height - 1)).w,
                              picture.at(std::max(x - 1, 0), y).w, picture.at(std::min(x + 1, picture.width - 1), y).w};
      for (std::size_t n = 0; n < 4; ++n) {
        ASSERT_LE(shares[n], 0.51);
        if (std::isnan(sides[n])) {
          ASSERT_EQ(shares[n], 0.0) << "nothing is taken from a pixel without a number";
        }
      }
    }
}

TEST_F(AntialiasingWeights, are_zero_where_nothing_is_slanted) {
  const std::pair<const char*, ShownPicture> pictures[] = {
      {"even", {70, 50, [](int, int) { return 0.4; }}},
      {"one bright pixel", {21, 19, [](int x, int y) { return x == 10 && y == 9 ? 1.0 : 0.0; }}},
      {"a horizontal edge", {70, 50, [](int, int y) { return y < 21 ? 0.1 : 0.9; }}},
      {"a vertical edge", {70, 50, [](int x, int) { return x < 33 ? 0.1 : 0.9; }}},
      {"a rectangle", {70, 50, [](int x, int y) { return x > 8 && x < 60 && y > 5 && y < 31 ? 0.9 : 0.2; }}},
      {"a horizontal line", {70, 50, [](int x, int y) { return y == 17 && x > 4 ? 0.9 : 0.2; }}},
      {"a gradient", {70, 50, [](int x, int y) { return 0.004 * (x + y); }}},
      {"tiles", {70, 50, [](int x, int y) { return (x / 4 + y / 4) % 2 == 0 ? 0.9 : 0.1; }}}};
  for (const auto& [name, picture] : pictures) {
    const auto [weights, rectangles] = find_weights(*device(), picture);
    for (const std::uint32_t word : weights) ASSERT_EQ(word, 0u) << name;
    EXPECT_TRUE(rectangles.empty()) << name << ": nothing is blended";
  }
}

TEST_F(AntialiasingWeights, are_zero_where_contours_may_go_either_way) {
  const ShownPicture board(70, 50, [](int x, int y) { return (x + y) % 2 == 0 ? 0.9 : 0.1; });
  const std::vector<std::uint32_t> weights = antialiasing_weights(*device(), board);
  for (int y = 2; y < 48; ++y)
    for (int x = 2; x < 68; ++x) ASSERT_EQ(weights[static_cast<std::size_t>(y * 70 + x)], 0u) << x << ", " << y;
}

TEST_F(AntialiasingWeights, turn_with_the_picture) {
  const ShownPicture upright = slanted(63, 63, 0.35);
  const ShownPicture turned(63, 63, [&](int x, int y) { return static_cast<double>(upright.at(y, x).x); });
  const std::vector<std::uint32_t> first = antialiasing_weights(*device(), upright);
  const std::vector<std::uint32_t> second = antialiasing_weights(*device(), turned);
  std::size_t same = 0;
  for (int y = 0; y < 63; ++y)
    for (int x = 0; x < 63; ++x) {
      const std::uint32_t word = second[static_cast<std::size_t>(x * 63 + y)];
      same += first[static_cast<std::size_t>(y * 63 + x)] == (word >> 16 | word << 16) ? 1 : 0;
    }
  EXPECT_GT(same, 63u * 63u - 60u) << "all but ties between the axes";
}

}  // namespace
}  // namespace gloam::test
