// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/pictures/legend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/render/passes/visualizer_pass.h"

namespace gloam {
namespace {

Picture grey(std::uint32_t width, std::uint32_t height) {
  return {.width = width, .height = height, .rgba = std::vector<std::uint8_t>(std::size_t{width} * height * 4, 200)};
}

TEST(Legend, a_scale_has_the_colours_of_the_view) {
  EXPECT_EQ(heat_color(0.0), vec3(0.0f));
  EXPECT_EQ(heat_color(1.01), vec3(1.0f));
  EXPECT_GT(heat_color(1.0).r, 10.0f * heat_color(1.0).g) << "red";
  EXPECT_GT(heat_color(0.6).g, 5.0f * heat_color(0.6).r) << "green";
}

TEST(Legend, a_bar_runs_from_black_to_red_above_the_text) {
  Picture picture = grey(320, 180), plain = grey(320, 180);
  draw_legend(plain, "numbers");
  draw_legend(picture, "numbers", {31.0}, 1.0f);
  const auto texel = [&](int x, int y) { return &picture.rgba[4 * (static_cast<std::size_t>(y) * 320 + x)]; };
  int bar_rows = 0;
  for (int y = 100; y < 180; ++y) {
    const auto *first = texel(5, y), *last = texel(242, y);
    const bool black = first[0] < 30 && first[1] < 30 && first[2]<60, red = last[0]> 200 && last[1] < 60;
    bar_rows += black && red ? 1 : 0;
  }
  EXPECT_EQ(bar_rows, 6);
  const auto darkened = [](const Picture& p) { return std::ranges::count(p.rgba, std::uint8_t{50}); };
  EXPECT_GT(darkened(picture), darkened(plain)) << "the strip is higher";
}

TEST(Legend, covers_the_rows_that_it_says_and_no_other) {
  for (const HeatScale& heat : {HeatScale{}, HeatScale{.most = 31.0, .counts = true}}) {
    Picture picture = grey(320, 180);
    const std::uint32_t rows = draw_legend(picture, "numbers of lights in each tile", heat);
    ASSERT_GT(rows, 12u);
    ASSERT_LT(rows, 60u);
    const auto row = [&](std::uint32_t y) {
      const auto begin = picture.rgba.begin() + static_cast<std::ptrdiff_t>(y) * 320 * 4;
      return std::vector<std::uint8_t>(begin, begin + 320 * 4);
    };
    for (std::uint32_t y = 0; y < 180; ++y)
      EXPECT_EQ(row(y) == std::vector<std::uint8_t>(320 * 4, 200), y < 180 - rows) << y;
  }
  Picture tiny = grey(60, 20);
  EXPECT_EQ(draw_legend(tiny, "numbers"), 0u);
}

TEST(Legend, small_pictures_have_no_bar) {
  Picture picture = grey(100, 60), plain = grey(100, 60), tiny = grey(60, 20);
  draw_legend(picture, "numbers", {31.0}, 1.0f);
  draw_legend(plain, "numbers");
  EXPECT_EQ(picture.rgba, plain.rgba);
  draw_legend(tiny, "numbers", {31.0}, 1.0f);
  EXPECT_EQ(tiny.rgba, grey(60, 20).rgba);
}

}  // namespace
}  // namespace gloam
