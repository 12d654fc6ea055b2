// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/arena.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

bool aligned(const void* address, std::size_t alignment) {
  return reinterpret_cast<std::uintptr_t>(address) % alignment == 0;
}

TEST(Arena, takes_no_memory_before_it_is_used) {
  const Arena arena(1024);
  EXPECT_EQ(arena.reserved_bytes(), 0u);
  EXPECT_EQ(arena.used_bytes(), 0u);
}

TEST(Arena, spans_are_value_initialised_even_in_reused_memory) {
  Arena arena(256);
  for (int round = 0; round < 3; ++round) {
    const std::span<int> numbers = arena.make_span<int>(32);
    ASSERT_EQ(numbers.size(), 32u);
    for (int& n : numbers) {
      EXPECT_EQ(n, 0);
      n = -1;
    }
    arena.reset();
  }
}

TEST(Arena, members_with_defaults_get_them) {
  struct Item {
    int value = 7;
  };
  Arena arena;
  for (const Item& item : arena.make_span<Item>(10)) EXPECT_EQ(item.value, 7);
}

TEST(Arena, a_span_of_nothing_takes_nothing) {
  Arena arena;
  EXPECT_TRUE(arena.make_span<int>(0).empty());
  EXPECT_TRUE(arena.copy(std::span<const int>()).empty());
  EXPECT_EQ(arena.reserved_bytes(), 0u);
}

TEST(Arena, copies_hold_the_items) {
  Arena arena;
  const int numbers[] = {3, 1, 4, 1, 5};
  const std::span<int> copy = arena.copy(std::span<const int>(numbers));
  EXPECT_TRUE(std::equal(copy.begin(), copy.end(), std::begin(numbers), std::end(numbers)));
  EXPECT_NE(copy.data(), numbers);
}

TEST(Arena, every_power_of_two_alignment_is_kept) {
  Arena arena(64);
  for (int round = 0; round < 4; ++round) {
    for (std::size_t alignment = 1; alignment <= 4096; alignment *= 2) {
      (void)arena.allocate_bytes(1, 1);  // leaves the next address odd
      EXPECT_TRUE(aligned(arena.allocate_bytes(24, alignment), alignment)) << alignment;
    }
  }
  struct alignas(64) Line {
    std::uint8_t data[64];
  };
  EXPECT_TRUE(aligned(arena.make_span<Line>(3).data(), 64));
}

TEST(Arena, earlier_spans_stay_where_they_are_while_it_grows) {
  Arena arena(64);
  std::vector<std::span<std::uint32_t>> spans;
  for (std::uint32_t i = 0; i < 500; ++i) {
    spans.push_back(arena.make_span<std::uint32_t>(1 + i % 37));
    for (std::uint32_t& v : spans.back()) v = i;
  }
  for (std::uint32_t i = 0; i < 500; ++i) {
    for (std::uint32_t v : spans[i]) ASSERT_EQ(v, i);
  }
}

TEST(Arena, a_request_larger_than_a_block_gets_its_own) {
  Arena arena(16);
  const std::span<std::uint64_t> large = arena.make_span<std::uint64_t>(100000);
  large.back() = 1;
  EXPECT_GE(arena.reserved_bytes(), large.size_bytes());
}

TEST(Arena, blocks_grow_so_that_many_small_requests_take_few) {
  Arena arena(64);
  for (int i = 0; i < 100000; ++i) (void)arena.allocate_bytes(8, 8);
  EXPECT_LE(arena.reserved_bytes(), 4u * 100000u * 8u);
}

TEST(Arena, after_a_reset_the_same_load_takes_no_more_memory) {
  Arena arena(64);
  const auto load = [&] {
    for (std::size_t i = 1; i < 200; ++i) (void)arena.make_span<double>(i % 17);
  };
  load();
  arena.reset();
  EXPECT_EQ(arena.used_bytes(), 0u);
  const std::size_t reserved = arena.reserved_bytes();
  for (int round = 0; round < 5; ++round) {
    load();
    EXPECT_EQ(arena.reserved_bytes(), reserved);
    arena.reset();
  }
}

TEST(Arena, counts_the_bytes_in_use) {
  Arena arena;
  (void)arena.allocate_bytes(3, 1);
  (void)arena.allocate_bytes(4, 4);
  EXPECT_EQ(arena.used_bytes(), 8u);
}

TEST(Arena, misuse_asserts) {
  Arena arena;
  EXPECT_ASSERT(Arena(0), "at least one byte");
  EXPECT_ASSERT((void)arena.allocate_bytes(8, 3), "power of two");
  EXPECT_ASSERT((void)arena.allocate_bytes(SIZE_MAX, 8), "fits in size_t");
  EXPECT_ASSERT((void)arena.make_span<int>(SIZE_MAX / 2), "fit in size_t");
}

}  // namespace
}  // namespace gloam
