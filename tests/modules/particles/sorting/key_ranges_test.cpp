// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/sorting/key_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gloam {
namespace {

VisibleEmitter between(double near_m, double far_m) {
  VisibleEmitter emitter;
  emitter.near_m = near_m;
  emitter.far_m = far_m;
  return emitter;
}

std::uint32_t key_of(const KeyRange& range, double depth) {
  const double at = std::max((range.far_m - depth) * range.keys_per_m, 0.0);
  return range.first + std::min(static_cast<std::uint32_t>(at), range.count - 1);
}

TEST(KeyRanges, order_all_depths_to_one_quantum) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    std::vector<VisibleEmitter> emitters;
    for (int i = 0; i <= round % 40; ++i) {
      const double near_m = 0.1 + 200.0 * unit(random) * unit(random);
      emitters.push_back(between(near_m, near_m + 0.01 + 20.0 * unit(random) * unit(random)));
    }
    const std::uint32_t keys = round % 2 == 0 ? kOneDigitKeys : kTwoDigitKeys;
    const std::vector<KeyRange> ranges = key_ranges(emitters, keys);
    struct Sample {
      double depth, quantum;
      std::uint32_t key;
    };
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < emitters.size(); ++i)
      for (int j = 0; j < 20; ++j) {
        const double depth = emitters[i].near_m + unit(random) * (emitters[i].far_m - emitters[i].near_m);
        samples.push_back({depth, 1.0 / ranges[i].keys_per_m, key_of(ranges[i], depth)});
        EXPECT_LT(samples.back().key, keys);
      }
    std::ranges::sort(samples, [](const Sample& a, const Sample& b) { return a.key < b.key; });
    double nearest = 1e9;  // so far; the next one must not be farther by more than a quantum
    for (const Sample& sample : samples) {
      EXPECT_LE(sample.depth, nearest + sample.quantum * (1.0 + 1e-6));
      nearest = std::min(nearest, sample.depth);
    }
  }
}

TEST(KeyRanges, emitters_that_overlap_in_depth_share_a_range) {
  const std::vector<VisibleEmitter> emitters = {between(5.0, 7.0), between(20.0, 30.0), between(6.0, 9.0),
                                                between(8.5, 10.0)};
  const std::vector<KeyRange> ranges = key_ranges(emitters, 200);
  EXPECT_EQ(ranges[1].first, 0u);
  EXPECT_EQ(ranges[1].count, 100u);
  for (const int i : {0, 2, 3}) {
    EXPECT_EQ(ranges[static_cast<std::size_t>(i)].first, 100u);
    EXPECT_EQ(ranges[static_cast<std::size_t>(i)].far_m, 10.0);
    EXPECT_DOUBLE_EQ(ranges[static_cast<std::size_t>(i)].keys_per_m, 20.0);
  }
}

TEST(KeyRanges, no_emitters_have_no_ranges) { EXPECT_TRUE(key_ranges({}, 255).empty()); }

TEST(KeyRanges, as_many_emitters_as_keys_have_one_each) {
  std::vector<VisibleEmitter> emitters;
  for (int i = 0; i < 255; ++i) emitters.push_back(between(2.0 * i + 1.0, 2.0 * i + 2.0));
  const std::vector<KeyRange> ranges = key_ranges(emitters, 255);
  for (std::size_t i = 0; i < 255; ++i) {
    EXPECT_EQ(ranges[i].count, 1u);
    EXPECT_EQ(ranges[i].first, 254 - i);
  }
}

}  // namespace
}  // namespace gloam
