// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/bins/z_bins.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/modules/lights/bins/z_bin_oracle.h"

namespace gloam {
namespace {

/// The sets computed from their definition, with the bins of every light.
ZBins made_plainly(const std::vector<LightDepth>& lights, const ZBinParams& params) {
  ZBins bins;
  bins.params = params;
  bins.bins.assign(std::size_t{2} * params.count, ZBin{});
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    for (std::uint32_t k = z_bin_of(lights[i].nearest, params); k <= z_bin_of(lights[i].farthest, params); ++k) {
      bins.bins[k].begin = std::min(bins.bins[k].begin, static_cast<std::uint16_t>(i));
      bins.bins[k].end = static_cast<std::uint16_t>(i + 1);
    }
  }
  for (std::uint32_t k = 0; k < params.count; ++k) {
    ZBin& ranged = bins.bins[params.count + k];
    for (std::uint32_t j = k; j < params.count; ++j) ranged.begin = std::min(ranged.begin, bins.bins[j].begin);
    for (std::uint32_t j = 0; j <= k; ++j) ranged.end = std::max(ranged.end, bins.bins[j].end);
  }
  return bins;
}

/// Lights whose ends are well inside bins, so that widening changes nothing.
std::vector<LightDepth> lights_inside_bins(std::uint32_t count, float longest, std::mt19937& random) {
  std::uniform_int_distribution<int> first(0, 59);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  std::vector<LightDepth> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto begin = static_cast<float>(1 + first(random)) + 0.3f;
    lights.push_back({begin, std::floor(begin + longest * share(random)) + 0.7f});
  }
  test::sort_lights(lights);
  return lights;
}

TEST(ZBins, are_those_of_the_definition) {
  std::mt19937 random(1);
  const ZBinParams params{1.0f, 65.0f, 64};
  for (const float longest : {0.0f, 1.0f, 5.0f, 30.0f, 200.0f}) {
    for (const std::uint32_t count : {0u, 1u, 2u, 7u, 100u, 1024u}) {
      const std::vector<LightDepth> lights = lights_inside_bins(count, longest, random);
      EXPECT_EQ(test::built(lights, params).bins, made_plainly(lights, params).bins)
          << count << " lights up to " << longest;
    }
  }
}

TEST(ZBins, are_the_same_from_memory_of_earlier_ones) {
  std::mt19937 random(2);
  const ZBinParams params{1.0f, 65.0f, 64};
  ZBinScratch scratch;
  for (const std::uint32_t count : {500u, 3u, 0u, 80u}) {
    const std::vector<LightDepth> lights = lights_inside_bins(count, 9.0f, random);
    std::vector<ZBin> bins(128);
    build_z_bins(lights, params, scratch, std::span(bins).first(64), std::span(bins).last(64));
    EXPECT_EQ(bins, test::built(lights, params).bins);
  }
}

TEST(ZBins, hold_lights_that_are_no_numbers_everywhere_and_all_others) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<LightDepth> lights = {{2.5f, 3.5f}, {nan, nan}, {10.5f, nan}, {40.5f, 41.5f}};
  const ZBins bins = test::built(lights, {1.0f, 65.0f, 64});
  for (std::uint32_t k = 0; k < 64; ++k) EXPECT_TRUE(test::contains(bins.bins[k], 1)) << k;
  for (std::uint32_t k = 10; k < 64; ++k) EXPECT_TRUE(test::contains(bins.bins[k], 2)) << k;
  EXPECT_TRUE(test::contains(bins.bins[40], 3));
}

}  // namespace
}  // namespace gloam
