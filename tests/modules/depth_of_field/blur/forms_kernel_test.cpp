// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>

#include "tests/modules/depth_of_field/support/dof_chain.h"

namespace gloam::test {
namespace {

class DofForms : public DofChainTest {
 protected:
  /// Light and circles at random: blocks of 8 pixels in which both vary.
  static DofInput noise(std::uint32_t width, std::uint32_t height) {
    DofInput in(width, height, 0.0f);
    std::mt19937 random(width + height);
    const auto between = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (std::uint32_t y = 0; y < height; y += 8)
      for (std::uint32_t x = 0; x < width; x += 8) {
        const float circle = random() % 3 == 0 ? 0.0f : between(-34.0f, 34.0f);
        for (std::uint32_t v = y; v < std::min(height, y + 8); ++v)
          for (std::uint32_t u = x; u < std::min(width, x + 8); ++u) {
            in.coc[in.at(u, v)] = circle + between(0.0f, 0.4f);
            in.light[in.at(u, v)] = vec4(between(0.0f, 9.0f), between(0.0f, 1.0f), between(0.0f, 0.1f), 1.0f);
          }
      }
    return in;
  }
  /// The greatest number of steps of a half float between two pictures. All light is positive.
  static int steps_apart(const DofResult& a, const DofResult& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.halves.size(); ++i)
      for (std::size_t c = 0; c < 4; ++c)
        most = std::max(most, std::abs(static_cast<int>(a.halves[i][c]) - static_cast<int>(b.halves[i][c])));
    return most;
  }
  template <class Check>
  static void each_setting(const Check& check) {
    for (const auto& [width, height] : {std::pair{150u, 70u}, {67u, 131u}})
      for (const bool full : {false, true})
        for (const float radius : {3.0f, 15.0f, 31.0f}) {
          DofInput in = noise(width, height);
          in.knobs.full_resolution = full;
          in.knobs.radius = radius;
          check(in);
        }
  }
  static DofResult with_cache(DofInput in, DofKnobs::Cache cache) {
    in.knobs.cache = cache;
    return run(in);
  }
};
INSTANTIATE_TEST_SUITE_P(Variants, DofForms, testing::Values(true));

TEST_P(DofForms, of_workgroup_memory_draw_the_same_to_the_bit) {
  each_setting([](DofInput in) {
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
      in.bokeh = bokeh;
      EXPECT_TRUE(with_cache(in, DofKnobs::Cache::vectors).halves == with_cache(in, DofKnobs::Cache::channels).halves)
          << in.width << ", radius " << in.knobs.radius;
    }
  });
}

TEST_P(DofForms, without_workgroup_memory_draw_the_same_to_the_bit) {
  each_setting([](DofInput in) {
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
      in.bokeh = bokeh;
      const DofResult none = with_cache(in, DofKnobs::Cache::none), cached = with_cache(in, DofKnobs::Cache::channels);
      EXPECT_EQ(steps_apart(none, cached), 0) << in.width << ", radius " << in.knobs.radius;
      EXPECT_TRUE(none.halves == with_cache(in, DofKnobs::Cache::device).halves);
    }
  });
}

TEST_P(DofForms, draw_the_same_twice) {
  DofInput in = noise(90, 70);
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const DofKnobs::Cache cache : {DofKnobs::Cache::none, DofKnobs::Cache::vectors, DofKnobs::Cache::channels}) {
      in.bokeh = bokeh;
      EXPECT_TRUE(with_cache(in, cache).halves == with_cache(in, cache).halves);
    }
}

}  // namespace
}  // namespace gloam::test
