// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/statistics.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace gloam {
namespace {

/// One layer from text: '#' traced unlit, '.' lit, '+' half, ' ' not judged.
TracedVisibility traced_from(std::vector<std::string_view> rows) {
  TracedVisibility traced;
  traced.width = static_cast<std::uint32_t>(rows.front().size());
  traced.height = static_cast<std::uint32_t>(rows.size());
  traced.lights = {Entity{1, 1}};
  traced.judged.assign((traced.pixels() + 7) / 8, 0);
  for (const std::string_view row : rows)
    for (const char c : row) {
      const std::size_t at = traced.visibility.size();
      traced.visibility.push_back(c == '#' ? 0 : c == '+' ? 128 : 255);
      if (c != ' ') traced.judged[at / 8] = static_cast<std::uint8_t>(traced.judged[at / 8] | 1u << (at % 8));
    }
  return traced;
}

std::vector<float> drawn_from(std::vector<std::string_view> rows) {
  std::vector<float> drawn;
  for (const std::string_view row : rows)
    for (const char c : row) drawn.push_back(c == '#' ? 0.0f : c == '+' ? 128.0f / 255.0f : 1.0f);
  return drawn;
}

TEST(ShadowStatistics, the_same_visibilities_have_no_error) {
  const std::vector<std::string_view> rows = {"..##", "..+#", "...."};
  const ShadowError error = compare_visibility(traced_from(rows), 0, drawn_from(rows));
  EXPECT_EQ(error.pairs, 12u);
  EXPECT_EQ(error.penumbra_pairs, 1u);
  EXPECT_NEAR(error.mean(), 0.0, 1e-7);
  EXPECT_EQ(error.wrong + error.acne + error.leaks, 0u);
}

TEST(ShadowStatistics, nothing_to_compare_is_no_error) {
  const ShadowError error = compare_visibility(traced_from({"    "}), 0, drawn_from({"####"}));
  EXPECT_EQ(error.pairs, 0u);
  EXPECT_EQ(error.mean(), 0.0);
  EXPECT_EQ(error.penumbra_mean(), 0.0);
  EXPECT_EQ(error.wrong_share(), 0.0);
}

TEST(ShadowStatistics, means_are_over_pairs_that_the_light_reaches) {
  const ShadowError error = compare_visibility(traced_from({"..+  #"}), 0, drawn_from({"#.####"}));
  EXPECT_EQ(error.pairs, 4u);
  EXPECT_NEAR(error.mean(), (1.0 + 128.0 / 255.0) / 4.0, 1e-6);
  EXPECT_NEAR(error.penumbra_mean(), 128.0 / 255.0, 1e-6);
}

TEST(ShadowStatistics, the_pixels_at_a_silhouette_may_show_either_side) {
  // The traced silhouette is between columns 3 and 4. The drawn one is one pixel to the left, then two.
  const TracedVisibility traced = traced_from({"....####", "....####", "....####"});
  const ShadowError one = compare_visibility(traced, 0, drawn_from({"...#####", "...#####", "...#####"}));
  EXPECT_EQ(one.wrong, 0u);
  EXPECT_NEAR(one.mean(), 3.0 / 24.0, 1e-7);
  const ShadowError two = compare_visibility(traced, 0, drawn_from({"..######", "..######", "..######"}));
  EXPECT_EQ(two.wrong, 3u);
  EXPECT_EQ(two.acne, 3u);
  EXPECT_EQ(two.leaks, 0u);
  EXPECT_NEAR(two.wrong_share(), 3.0 / 24.0, 1e-12);
}

TEST(ShadowStatistics, silhouettes_are_seen_across_corners) {
  const TracedVisibility traced = traced_from({"...", "...", "..#"});
  const ShadowError error = compare_visibility(traced, 0, drawn_from({"#..", ".#.", "..#"}));
  EXPECT_EQ(error.wrong, 1u) << "the upper left one alone";
}

TEST(ShadowStatistics, acne_and_leaks_are_told_apart) {
  const TracedVisibility traced = traced_from({"......######", "......######", "......######"});
  const ShadowError error = compare_visibility(traced, 0, drawn_from({"......######", "..#...####.#", "......######"}));
  EXPECT_EQ(error.wrong, 2u);
  EXPECT_EQ(error.acne, 1u);
  EXPECT_EQ(error.leaks, 1u);
  EXPECT_NEAR(error.acne_share(), 1.0 / 36.0, 1e-12);
  EXPECT_NEAR(error.leak_share(), 1.0 / 36.0, 1e-12);
}

TEST(ShadowStatistics, half_lit_pixels_are_neither_acne_nor_leak) {
  TracedVisibility traced = traced_from({"....", "....", "...."});
  traced.visibility[5] = 250;
  std::vector<float> drawn(12, 1.0f);
  drawn[5] = 0.2f;
  const ShadowError error = compare_visibility(traced, 0, drawn);
  EXPECT_EQ(error.wrong, 1u);
  EXPECT_EQ(error.acne, 0u);
}

TEST(ShadowStatistics, pixels_that_shading_does_not_reach_are_counted_and_not_compared) {
  const TracedVisibility traced = traced_from({"....", "    "});
  const ShadowError one = compare_visibility(traced, 0, std::vector<float>{1.0f, -1.0f, 1.0f, 0.5f, -1.0f, 0, 0, 0});
  EXPECT_EQ(one.pairs, 3u);
  EXPECT_EQ(one.unreached, 1u) << "not the one that nobody judged";
  EXPECT_EQ(one.wrong, 0u);
  EXPECT_NEAR(one.difference, 0.5, 1e-7);
  ShadowError sum = one;
  sum += one;
  EXPECT_EQ(sum.unreached, 2u);
}

TEST(ShadowStatistics, layers_add_up) {
  TracedVisibility traced = traced_from({"...."});
  traced.lights.push_back(Entity{2, 1});
  traced.visibility.insert(traced.visibility.end(), 4, 0);
  traced.judged = {0xFF};
  ShadowError sum = compare_visibility(traced, 0, drawn_from({"...."}));
  sum += compare_visibility(traced, 1, drawn_from({"...."}));
  EXPECT_EQ(sum.pairs, 8u);
  EXPECT_NEAR(sum.mean(), 0.5, 1e-12);
  EXPECT_EQ(sum.leaks, 4u);
}

}  // namespace
}  // namespace gloam
