// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "modules/shadows/outputs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {
namespace {

TEST(DecodeFinalList, takes_both_runs_apart) {
  const FinalList list = decode_final_list({100, 200, 3u << 16 | 1024u, 0});
  EXPECT_TRUE(list.complete);
  EXPECT_EQ(list.directional_first, 100u);
  EXPECT_EQ(list.directional_count, 3u);
  EXPECT_EQ(list.local_first, 200u);
  EXPECT_EQ(list.local_count, 1024u);
}

TEST(DecodeFinalList, of_a_tile_without_one_has_no_entries) {
  const FinalList list = decode_final_list({GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0, 0});
  EXPECT_FALSE(list.complete);
  EXPECT_EQ(list.directional_count + list.local_count, 0u);
}

TEST(DecodeFinalEntry, has_10_bits_of_light_and_22_of_slot) {
  for (const std::uint32_t light : {0u, 1u, 511u, 1023u})
    for (const std::uint32_t slot : {0u, 1u, 0x1FFFFFu, 0x200000u, GLOAM_NO_ROOM - 1, GLOAM_ALL_LIT}) {
      const FinalEntry entry = decode_final_entry(slot * 1024u + light);
      EXPECT_EQ(entry.light, light);
      EXPECT_EQ(entry.slot, slot);
    }
}

TEST(DecodeVisibility, gives_what_was_stored_at_each_pixel_of_each_slot) {
  std::mt19937 random(3);
  for (const std::uint32_t bits : {4u, 8u}) {
    constexpr std::uint32_t kSlots = 5;
    const std::uint32_t most = bits == 4 ? 15 : 255;
    std::vector<std::uint32_t> steps(kSlots * 64), words(kSlots * 2 * bits);
    for (std::uint32_t i = 0; i < steps.size(); ++i) {
      steps[i] = static_cast<std::uint32_t>(random() % (most + 1));
      // Writes the bits one by one, the lowest first.
      for (std::uint32_t bit = 0; bit < bits; ++bit)
        words[(i * bits + bit) / 32] |= (steps[i] >> bit & 1u) << (i * bits + bit) % 32;
    }
    for (std::uint32_t i = 0; i < steps.size(); ++i)
      EXPECT_FLOAT_EQ(decode_visibility({7, i / 64}, i % 64, words, bits),
                      static_cast<float>(steps[i]) / static_cast<float>(most))
          << bits << " bits, value " << i;
  }
}

TEST(DecodeVisibility, knows_entries_without_a_slot) {
  const std::vector<std::uint32_t> words(16, 0x80808080u);
  EXPECT_EQ(decode_visibility({3, GLOAM_ALL_LIT}, 5, words, 8), 1.0f);
  EXPECT_EQ(decode_visibility({3, GLOAM_ALL_LIT}, 5, {}, 4), 1.0f);
  EXPECT_EQ(decode_visibility({3, GLOAM_ALL_UNLIT}, 5, words, 8), 0.0f);
  EXPECT_EQ(decode_visibility({3, 1}, 5, words, 8), 0.0f) << "beyond the words";
  EXPECT_EQ(decode_visibility({3, GLOAM_NO_ROOM - 1}, 63, words, 4), 0.0f);
}

}  // namespace
}  // namespace gloam
