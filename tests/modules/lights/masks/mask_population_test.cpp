// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/masks/mask_population.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace gloam {
namespace {

/// Masks of random lights, with words of absent groups left undefined, and the same as sets.
struct RandomMasks {
  RandomMasks(uvec2 tiles, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
    masks.tiles = tiles;
    masks.words.assign(std::size_t{tiles.x} * tiles.y * GLOAM_MASK_WORDS, 0xABCD1234u);
    sets.resize(std::size_t{tiles.x} * tiles.y);
    for (std::size_t tile = 0; tile < sets.size(); ++tile) {
      for (std::uint32_t i = below(40); i > 0; --i) sets[tile].insert(below(1024));
      std::uint32_t* words = masks.words.data() + tile * GLOAM_MASK_WORDS;
      words[0] = 0;
      for (const std::uint32_t light : sets[tile]) words[0] |= 1u << (light / 32);
      for (std::uint32_t group = 0; group < 32; ++group)
        if ((words[0] >> group & 1u) != 0) words[group + 1] = 0;
      for (const std::uint32_t light : sets[tile]) words[light / 32 + 1] |= 1u << (light % 32);
    }
  }
  TileLightMasks masks;
  std::vector<std::set<std::uint32_t>> sets;
};

TEST(MaskPopulation, is_the_sum_over_all_shadow_tiles) {
  const RandomMasks random(uvec2(3, 2), 5);
  std::vector<std::uint32_t> chosen(32, 0);
  for (std::uint32_t light = 0; light < 1024; light += 3) chosen[light / 32] |= 1u << (light % 32);
  // The right column and the lower row of mask tiles are cut off by the picture's edge.
  const uvec2 shadow_tiles(10, 7);
  for (const std::uint32_t step : {1u, 3u}) {
    std::uint64_t all = 0, some = 0;
    for (std::uint32_t y = 0; y < shadow_tiles.y; ++y)
      for (std::uint32_t x = 0; x < shadow_tiles.x; ++x) {
        const auto& lights = random.sets[y / 4 * 3 + x / 4];
        std::uint64_t counted = 0;
        for (const std::uint32_t light : lights) counted += light % 3 == 0 ? 1 : 0;
        all += (lights.size() + step - 1) / step * step;
        some += (counted + step - 1) / step * step;
      }
    EXPECT_EQ(mask_population(random.masks, shadow_tiles, {}, step), all) << step;
    EXPECT_EQ(mask_population(random.masks, shadow_tiles, chosen, step), some) << step;
  }
}

TEST(MaskPopulation, of_some_shadow_tiles_is_the_sum_over_these) {
  const RandomMasks random(uvec2(3, 2), 6);
  std::vector<std::uint32_t> chosen(32, 0);
  for (std::uint32_t light = 0; light < 1024; light += 3) chosen[light / 32] |= 1u << (light % 32);
  const uvec2 shadow_tiles(10, 7);
  std::vector<std::uint32_t> counted(3, 0);
  std::uint64_t all = 0, some = 0;
  for (std::uint32_t tile = 0; tile < 70; ++tile) {
    if (tile % 5 == 0 || tile % 7 == 3) continue;
    counted[tile / 32] |= 1u << (tile % 32);
    for (const std::uint32_t light : random.sets[tile / 10 / 4 * 3 + tile % 10 / 4]) {
      ++all;
      some += light % 3 == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(mask_population_of(random.masks, shadow_tiles, counted, {}), all);
  EXPECT_EQ(mask_population_of(random.masks, shadow_tiles, counted, chosen), some);
  EXPECT_EQ(mask_population_of(random.masks, shadow_tiles, std::vector<std::uint32_t>(3, 0), {}), 0u);
}

TEST(MaskPopulation, counts_no_light_beyond_the_chosen_words) {
  const RandomMasks random(uvec2(1, 1), 9);
  const std::vector<std::uint32_t> first = {~0u};
  std::uint64_t expected = 0;
  for (const std::uint32_t light : random.sets[0]) expected += light < 32 ? 16 : 0;
  EXPECT_EQ(mask_population(random.masks, uvec2(4, 4), first, 1), expected);
  EXPECT_EQ(mask_population({}, uvec2(4, 4), {}, 3), 0u);
}

}  // namespace
}  // namespace gloam
