// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "tests/modules/lights/bins/z_bin_oracle.h"

namespace gloam {
namespace {

using test::built;
using test::expect_right_bins;

// Hard case: shadows.lights_0, shadows.lights_1, shadows.lights_31, shadows.lights_32, shadows.lights_33
// Hard case: shadows.lights_5000
TEST(ZBinsHard, of_any_number_of_lights_hold_each_of_them) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u, 1025u, 5000u, 65535u}) {
    std::vector<LightDepth> lights;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float nearest = 0.1f + 99.0f * static_cast<float>(i) / static_cast<float>(count);
      lights.push_back({nearest, nearest + 0.3f * static_cast<float>(i % 7)});
    }
    expect_right_bins(lights, {0.1f, 100.0f, 1024});
  }
}

TEST(ZBinsHard, without_a_light_are_empty_in_both_sets) {
  const ZBins bins = built({}, {0.1f, 100.0f, 64});
  for (const ZBin& bin : bins.bins) EXPECT_EQ(bin, ZBin{});
  const ZBin found = z_bin_range(bins, 0.1f, 100.0f);
  EXPECT_GE(found.begin, found.end);
}

// Hard case: shadows.one_place, further.lights_1024_one_point
TEST(ZBinsHard, of_lights_in_one_place_hold_all_of_them) {
  for (const float depth : {0.1f, 37.25f, 100.0f, 5000.0f}) {
    const std::vector<LightDepth> lights(1024, {depth, depth});
    const ZBins bins = expect_right_bins(lights, {0.1f, 100.0f, 1024});
    EXPECT_EQ(bins.bins[z_bin_of(depth, bins.params)], (ZBin{0, 1024})) << depth;
  }
}

// Hard case: shadows.one_bin
TEST(ZBinsHard, of_lights_in_the_middle_of_one_bin_leave_all_other_bins_empty) {
  const ZBinParams params{1.0f, 65.0f, 64};  // bins of one metre
  std::vector<LightDepth> lights;
  for (int i = 0; i < 200; ++i) lights.push_back({20.25f + 0.002f * static_cast<float>(i), 20.7f});
  const ZBins bins = expect_right_bins(lights, params);
  for (std::uint32_t k = 0; k < params.count; ++k) EXPECT_EQ(bins.bins[k], k == 19 ? (ZBin{0, 200}) : ZBin{}) << k;
}

// Hard case: shadows.one_far_light
TEST(ZBinsHard, of_one_light_beyond_the_last_bin_hold_it_there_alone) {
  for (const float depth : {101.0f, 1e6f, 1e9f, 1e30f}) {
    const ZBins bins = expect_right_bins({{depth, depth}}, {0.1f, 100.0f, 1024});
    for (std::uint32_t k = 0; k < 1024; ++k) ASSERT_EQ(bins.bins[k], k == 1023 ? (ZBin{0, 1}) : ZBin{}) << k;
    EXPECT_EQ(z_bin_range(bins, 50.0f, 2e6f), (ZBin{0, 1}));
  }
}

TEST(ZBinsHard, of_a_light_around_everything_are_all_full) {
  for (const float farthest :
       {100.0f, 1e9f, std::numeric_limits<float>::max(), std::numeric_limits<float>::infinity()}) {
    const ZBins bins = built({{0.1f, farthest}}, {0.1f, 100.0f, 1024});
    for (const ZBin& bin : bins.bins) ASSERT_EQ(bin, (ZBin{0, 1})) << farthest;
  }
}

TEST(ZBinsHard, hold_a_light_on_the_edge_of_two_bins_from_both_sides) {
  for (const ZBinParams params :
       {ZBinParams{0.1f, 100.0f, 1024}, ZBinParams{1.0f, 65.0f, 64}, ZBinParams{0.01f, 1e5f, 4096}}) {
    const double width = (static_cast<double>(params.far_m) - static_cast<double>(params.near_m)) / params.count;
    for (std::uint32_t k = 0; k <= params.count; ++k) {
      const auto edge = static_cast<float>(static_cast<double>(params.near_m) + k * width);
      for (float depth : {std::nextafter(edge, 0.0f), edge, std::nextafter(edge, 1e9f)}) {
        depth = std::max(depth, params.near_m);
        const ZBins bins = built({{depth, depth}}, params);
        test::expect_found(bins, 0, depth);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

/// FF figure 3: twenty bins, three lights. Both errors come from using only the first and the last bin of a range.
// Hard case: shadows.figure_3_between, shadows.figure_3_empty
TEST(ZBinsHard, of_figure_3_find_what_lies_between_two_bins) {
  const ZBinParams params{1.0f, 21.0f, 20};  // bins of one metre
  const auto from_to = [](int first, int last) {
    return LightDepth{static_cast<float>(first) + 1.25f, static_cast<float>(last) + 1.75f};
  };
  const ZBins bins = expect_right_bins({from_to(2, 5), from_to(4, 12), from_to(6, 10)}, params);
  const auto at = [](int bin) { return static_cast<float>(bin) + 1.5f; };
  // 3a: bins 3 and 11 hold only lights 0 and 1; light 2 lies between them.
  EXPECT_EQ(bins.bins[3], (ZBin{0, 1}));
  EXPECT_EQ(bins.bins[11], (ZBin{1, 2}));
  EXPECT_EQ(z_bin_range(bins, at(3), at(11)), (ZBin{0, 3}));
  // 3b: bins 0 and 13 are empty; all lights lie between them.
  EXPECT_EQ(bins.bins[0], ZBin{});
  EXPECT_EQ(bins.bins[13], ZBin{});
  EXPECT_EQ(z_bin_range(bins, at(0), at(13)), (ZBin{0, 3}));
  // The paper's other cases: 2a at one depth, 2b over a range.
  EXPECT_EQ(z_bin_range(bins, at(10), at(10)), (ZBin{1, 3}));
  EXPECT_EQ(z_bin_range(bins, at(2), at(13)), (ZBin{0, 3}));
}

TEST(ZBinsHard, of_two_neighbours_take_the_standard_set_even_when_one_is_empty) {
  const ZBinParams params{1.0f, 21.0f, 20};
  const ZBins bins = built({{1.25f, 1.75f}, {5.25f, 5.75f}, {19.25f, 19.75f}}, params);
  EXPECT_EQ(z_bin_range(bins, 4.5f, 5.5f), (ZBin{1, 2})) << "empty, then full";
  EXPECT_EQ(z_bin_range(bins, 5.5f, 6.5f), (ZBin{1, 2})) << "full, then empty";
  const ZBin nothing = z_bin_range(bins, 8.5f, 9.5f);
  EXPECT_GE(nothing.begin, nothing.end) << "both empty";
}

TEST(ZBinsHard, between_lights_find_none_of_them_by_range) {
  const ZBins bins = built({{1.25f, 1.75f}, {19.25f, 19.75f}}, {1.0f, 21.0f, 20});
  // The begin comes from later bins, the end from earlier ones: light 1 begins later, light 0 has ended.
  const ZBin found = z_bin_range(bins, 5.5f, 12.5f);
  EXPECT_GE(found.begin, found.end);
}

// Hard case: shadows.near_to_far
TEST(ZBinsHard, from_a_centimetre_to_100_kilometres_lose_no_light) {
  std::mt19937 random(3);
  for (const std::uint32_t count : {1u, 2u, 256u, 1024u, 4096u}) {
    std::vector<LightDepth> lights;
    for (int i = 0; i < 700; ++i) {
      const auto draw = [&](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
      };
      const double nearest = draw(-2.0, 5.0);
      lights.push_back({static_cast<float>(nearest), static_cast<float>(nearest + draw(-3.0, 4.0))});
    }
    test::sort_lights(lights);
    expect_right_bins(lights, {0.01f, 1e5f, count});
  }
}

TEST(ZBinsHard, finer_than_a_float_lose_no_light) {
  // At large depths, the edges of neighbouring bins fall between two floats.
  const float near_m = 5000.0f;
  const float far_m = near_m + 0.25f;
  std::vector<LightDepth> lights;
  for (float depth = near_m; depth <= far_m; depth = std::nextafter(depth, 1e9f)) lights.push_back({depth, depth});
  expect_right_bins(lights, {near_m, far_m, 4096});
  expect_right_bins({{near_m, far_m}}, {near_m, std::nextafter(near_m, 1e9f), 1024});
}

TEST(ZBinsHard, of_depths_out_of_range_are_the_first_and_the_last) {
  const ZBinParams params{0.1f, 100.0f, 1024};
  for (const float depth : {0.0f, -1.0f, 0.05f, 0.1f, -std::numeric_limits<float>::infinity(), -1e30f})
    EXPECT_EQ(z_bin_of(depth, params), 0u) << depth;
  for (const float depth : {100.0f, 101.0f, 1e12f, 1e38f, std::numeric_limits<float>::infinity()})
    EXPECT_EQ(z_bin_of(depth, params), 1023u) << depth;
}

TEST(ZBinsHard, stay_in_bounds_for_a_depth_that_is_not_a_number) {
  EXPECT_LT(z_bin_of(std::numeric_limits<float>::quiet_NaN(), {0.1f, 100.0f, 1024}), 1024u);
}

TEST(ZBinsHard, overwrite_what_was_in_the_spans) {
  const ZBinParams params{1.0f, 21.0f, 20};
  std::vector<ZBin> standard(20, ZBin{7, 99});
  std::vector<ZBin> ranged(20, ZBin{7, 99});
  build_z_bins({}, params, standard, ranged);
  for (const ZBin& bin : standard) EXPECT_EQ(bin, ZBin{});
  for (const ZBin& bin : ranged) EXPECT_EQ(bin, ZBin{});
}

TEST(ZBinsHard, of_lights_with_equal_near_depths_keep_their_order) {
  // Alternating long and short lights: a far bin must reach from the first long light to the last one.
  std::vector<LightDepth> lights;
  for (int i = 0; i < 64; ++i) lights.push_back({5.5f, i % 4 == 1 ? 50.5f : 5.6f});
  const ZBins bins = expect_right_bins(lights, {1.0f, 65.0f, 64});
  EXPECT_EQ(bins.bins[40], (ZBin{1, 62}));
}

}  // namespace
}  // namespace gloam
