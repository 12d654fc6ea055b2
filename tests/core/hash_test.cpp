// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gloam {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// Pinned: files and golden reports contain digests, so a change of these numbers changes a file format.
TEST(Hash, digests_keep_their_pinned_values) {
  EXPECT_EQ(Hasher().digest(), 0xcbf29ce44fd0bfc1ull);
  EXPECT_EQ(hash_bytes({}), 0x2d06800538d394c2ull);
  EXPECT_EQ(hash_bytes(bytes_of("gloam")), 0xe0548d667dee5facull);
  EXPECT_EQ(Hasher().text("gloam").digest(), 0xb5fefa44d9861de0ull);
  EXPECT_EQ(Hasher().value(42u).digest(), 0x11e412b9de05ed19ull);
  EXPECT_EQ(Hasher().value(-1).digest(), 0x4ece1cec3906b407ull);
  EXPECT_EQ(Hasher().value(1).value(2).digest(), 0x734414ea5d4fbda9ull);
}

TEST(Hash, order_matters) { EXPECT_NE(Hasher().value(1).value(2).digest(), Hasher().value(2).value(1).digest()); }

TEST(Hash, the_width_of_an_integer_does_not_matter) {
  EXPECT_EQ(Hasher().value(std::uint8_t{200}).digest(), Hasher().value(std::uint64_t{200}).digest());
  EXPECT_EQ(Hasher().value(std::int8_t{-3}).digest(), Hasher().value(std::int64_t{-3}).digest());
}

TEST(Hash, enumerations_hash_as_their_number) {
  enum class Colour : std::uint8_t { red = 1 };
  EXPECT_EQ(Hasher().value(Colour::red).digest(), Hasher().value(1).digest());
}

TEST(Hash, texts_of_different_cuts_differ) {
  EXPECT_NE(Hasher().text("ab").text("c").digest(), Hasher().text("a").text("bc").digest());
  EXPECT_NE(Hasher().text("").digest(), Hasher().digest());
}

TEST(Hash, bytes_of_different_cuts_differ) {
  EXPECT_NE(Hasher().bytes(bytes_of("glo")).bytes(bytes_of("am")).digest(), Hasher().bytes(bytes_of("gloam")).digest());
  EXPECT_NE(Hasher().bytes({}).digest(), Hasher().digest());
}

TEST(Hash, items_hash_as_their_number_and_their_bytes) {
  const std::vector<float> values = {1.0f, -2.5f};
  const auto bytes = std::as_bytes(std::span(values));
  EXPECT_EQ(Hasher().items(values).digest(), Hasher().value(2).bytes(bytes).digest());
  EXPECT_EQ(Hasher().items(std::span(values)).digest(), Hasher().items(values).digest());
  EXPECT_EQ(Hasher().items(std::vector<float>()).digest(), Hasher().value(0).bytes({}).digest());
}

TEST(Hash, a_value_hashes_as_its_bytes) {
  const std::array<float, 2> value = {1.0f, -2.5f};
  EXPECT_EQ(Hasher().bytes_of(value).digest(), Hasher().bytes(std::as_bytes(std::span(value))).digest());
}

TEST(Hash, small_integers_do_not_collide) {
  std::vector<std::uint64_t> digests;
  for (int i = -5000; i < 5000; ++i) digests.push_back(Hasher().value(i).digest());
  std::sort(digests.begin(), digests.end());
  EXPECT_EQ(std::adjacent_find(digests.begin(), digests.end()), digests.end());
}

}  // namespace
}  // namespace gloam
