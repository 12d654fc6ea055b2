// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/outputs.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <random>

#include "shaders/lights/lights_shared.h"
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

TEST(DecodeLightMask, lists_set_bits_of_words_whose_group_bit_is_set) {
  std::array<std::uint32_t, GLOAM_MASK_WORDS> words;
  words.fill(0xDEADBEEFu);
  words[0] = 0;
  EXPECT_THAT(decode_light_mask(words), IsEmpty());
  words[0] = 1u | 2u | 1u << 31;
  words[1] = 0x80000001u;
  words[2] = 0x2u;
  words[32] = 0x80000000u;
  EXPECT_THAT(decode_light_mask(words), ElementsAre(0u, 31u, 33u, 1023u));
}

TEST(DecodeLightMask, needs_all_words) {
  const std::array<std::uint32_t, 32> words{};
  EXPECT_NE(test::assertion_of([&] { static_cast<void>(decode_light_mask(words)); }), "(no assertion failed)");
}

TEST(DecodeLightList, reads_three_lights_a_word_from_any_entry_on) {
  const std::array<std::uint32_t, 2> words = {5u | 1023u << 10 | 0u << 20, 7u | 8u << 10 | 512u << 20};
  EXPECT_THAT(decode_light_list(words, 0, 6), ElementsAre(5u, 1023u, 0u, 7u, 8u, 512u));
  EXPECT_THAT(decode_light_list(words, 2, 2), ElementsAre(0u, 7u));
  EXPECT_THAT(decode_light_list(words, 3, 0), IsEmpty());
}

TEST(DecodeLightList, leaves_out_entries_beyond_the_buffer) {
  const std::array<std::uint32_t, 1> words = {1u | 2u << 10 | 3u << 20};
  EXPECT_THAT(decode_light_list(words, 1, 9), ElementsAre(2u, 3u));
  EXPECT_THAT(decode_light_list(words, GLOAM_NO_SLOT, 0xFFFFu), IsEmpty());
}

}  // namespace
}  // namespace gloam
