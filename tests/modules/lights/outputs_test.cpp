// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/outputs.h"

#include <gmock/gmock.h>

#include <array>
#include <random>

#include "shaders/lights/lights_shared.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(DecodeTileList, tells_slot_and_counts_apart) {
  const TileList tile = decode_tile_list(uvec2(12, 7u << 16 | 5u));
  EXPECT_TRUE(tile.has_list);
  EXPECT_EQ(tile.slot, 12u);
  EXPECT_EQ(tile.count, 5u);
  EXPECT_EQ(tile.approx_count, 7u);
}

TEST(DecodeTileList, knows_a_tile_without_room) {
  const TileList tile = decode_tile_list(uvec2(GLOAM_NO_SLOT, 1024u << 16 | 1000u));
  EXPECT_FALSE(tile.has_list);
  EXPECT_EQ(tile.count, 1000u);
  EXPECT_EQ(tile.approx_count, 1024u);
}

TEST(DecodeLightMask, turns_any_set_back_into_its_indices) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::array<std::uint32_t, GLOAM_MASK_WORDS> words{};
    std::vector<std::uint32_t> set;
    for (std::uint32_t i = 0; i < 1024; ++i) {
      if (random() % 50 >= static_cast<unsigned>(round)) continue;
      set.push_back(i);
      words[1 + i / 32] |= 1u << i % 32;
      words[0] |= 1u << i / 32;
    }
    ASSERT_EQ(decode_light_mask(words), set);
  }
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
