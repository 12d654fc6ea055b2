// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/outputs.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(DecodeTileMask, lists_set_bits_in_ascending_order) {
  std::array<std::uint32_t, 33> layers{};
  layers[0] = 0x80000001u;
  layers[1] = 0x2u;
  layers[31] = 0x80000000u;
  layers[32] = 1u | 2u | 1u << 31;
  EXPECT_THAT(decode_tile_mask(layers), ElementsAre(0u, 31u, 33u, 1023u));
}

TEST(DecodeTileMask, does_not_look_at_words_whose_group_bit_is_0) {
  std::array<std::uint32_t, 33> layers;
  layers.fill(0xDEADBEEFu);
  layers[32] = 0;
  EXPECT_THAT(decode_tile_mask(layers), IsEmpty());
  layers[32] = 1u << 5;
  layers[5] = 1u;
  EXPECT_THAT(decode_tile_mask(layers), ElementsAre(160u));
}

TEST(DecodeTileMask, turns_any_set_back_into_its_indices) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::array<std::uint32_t, 33> layers{};
    std::vector<std::uint32_t> set;
    for (std::uint32_t i = 0; i < 1024; ++i) {
      if (random() % 50 >= static_cast<unsigned>(round)) continue;
      set.push_back(i);
      layers[i / 32] |= 1u << i % 32;
      layers[32] |= 1u << i / 32;
    }
    ASSERT_EQ(decode_tile_mask(layers), set);
  }
}

TEST(DecodeTileMask, needs_all_words) {
  const std::array<std::uint32_t, 32> layers{};
  EXPECT_NE(test::assertion_of([&] { static_cast<void>(decode_tile_mask(layers)); }), "(no assertion failed)");
}

}  // namespace
}  // namespace gloam
