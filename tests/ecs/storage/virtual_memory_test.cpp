// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/virtual_memory.h"

#include <gmock/gmock.h>

#include <new>
#include <utility>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(ReservedMemory, committed_pages_are_zero_and_writable) {
  const std::size_t page = ReservedMemory::page_size();
  ReservedMemory memory(page * 1000);
  memory.commit(0, page);
  memory.commit(page * 7, page * 9);
  EXPECT_EQ(memory.data()[0], std::byte{0});
  EXPECT_EQ(memory.data()[page * 9 - 1], std::byte{0});
  memory.data()[page - 1] = std::byte{1};
  memory.data()[page * 7] = std::byte{2};
  EXPECT_EQ(memory.data()[page - 1], std::byte{1});
}

TEST(ReservedMemory, takes_address_space_and_no_memory) {
  const ReservedMemory memory(std::size_t{1} << 36);
  EXPECT_NE(memory.data(), nullptr);
  EXPECT_EQ(memory.size(), std::size_t{1} << 36);
}

TEST(ReservedMemory, throws_when_address_space_is_used_up) {
  try {
    const ReservedMemory memory(std::size_t{1} << 62);
    FAIL() << "there is no such address space";
  } catch (const std::bad_alloc& fault) {
    EXPECT_THAT(fault.what(), ::testing::HasSubstr("vm.max_map_count"));
  }
}

TEST(ReservedMemory, moves_with_its_pages) {
  ReservedMemory first(1);
  first.commit(0, ReservedMemory::page_size());
  std::byte* data = first.data();
  ReservedMemory second(std::move(first));
  EXPECT_EQ(second.data(), data);
  ReservedMemory third;
  third = std::move(second);
  EXPECT_EQ(third.data(), data);
}

TEST(ReservedMemory, commits_whole_pages_within_the_reservation) {
  const std::size_t page = ReservedMemory::page_size();
  ReservedMemory memory(page * 2);
  EXPECT_ASSERT(memory.commit(0, page * 3), "within their reservation");
  EXPECT_ASSERT(memory.commit(1, page), "by whole pages");
}

TEST(ReservedMemory, extends_a_stretch_by_pages_and_a_long_one_by_large_pages) {
  const std::size_t page = ReservedMemory::page_size();
  const std::size_t large = ReservedMemory::kLargePage;
  ReservedMemory memory(large * 5);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.data()) % large, 0u);
  ReservedMemory::Stretch stretch{.begin = large, .limit = large * 3 + page, .committed = large};
  memory.extend(stretch, large + 1);
  EXPECT_EQ(stretch.committed, large + page);
  std::byte* const bytes = memory.data() + large;
  bytes[0] = std::byte{1};
  bytes[page - 1] = std::byte{2};
  memory.extend(stretch, large + page * 2 + 5);
  EXPECT_EQ(stretch.committed, large + page * 3);
  memory.extend(stretch, large + large / 2);
  EXPECT_EQ(stretch.committed, large * 2);
  EXPECT_EQ(bytes[0], std::byte{1}) << "values outlive a change of pages";
  EXPECT_EQ(bytes[page - 1], std::byte{2});
  EXPECT_EQ(bytes[large - 1], std::byte{0});
  bytes[large - 1] = std::byte{3};
  memory.extend(stretch, large * 2 + 1);
  EXPECT_EQ(stretch.committed, large * 3);
  memory.extend(stretch, stretch.limit);
  EXPECT_EQ(stretch.committed, stretch.limit);
  memory.data()[stretch.limit - 1] = std::byte{4};
  EXPECT_EQ(bytes[large - 1], std::byte{3});
}

TEST(PackedMemory, gives_pieces_side_by_side_that_stay) {
  PackedMemory memory;
  std::byte* const first = memory.take(100);
  first[99] = std::byte{1};
  EXPECT_EQ(memory.take(1), first + 128);
  std::byte* const large = memory.take(std::size_t{100} << 20);
  large[(std::size_t{100} << 20) - 1] = std::byte{2};
  for (int i = 0; i < 3000; ++i) {
    std::byte* const piece = memory.take(30'000);
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(piece) % 64, 0u);
    ASSERT_EQ(piece[0], std::byte{0});
    ASSERT_EQ(piece[29'999], std::byte{0});
    piece[29'999] = std::byte{3};
  }
  EXPECT_EQ(first[99], std::byte{1});
  EXPECT_EQ(large[(std::size_t{100} << 20) - 1], std::byte{2});
}

TEST(VirtualArray, grows_without_moving) {
  VirtualArray<int> array(1'000'000);
  array.push_back(0);
  const int* first = &array[0];
  for (int i = 1; i < 1'000'000; ++i) array.push_back(i);
  EXPECT_EQ(&array[0], first);
  for (int i = 0; i < 1'000'000; ++i) ASSERT_EQ(array[static_cast<std::size_t>(i)], i);
  EXPECT_ASSERT(array.push_back(0), "is full");
}

TEST(VirtualArray, reserves_up_to_its_limit) {
  VirtualArray<std::uint64_t> array(10'000);
  array.reserve(10'000);
  EXPECT_EQ(array.size(), 0u);
  EXPECT_ASSERT(array.reserve(10'001), "is full");
}

}  // namespace
}  // namespace gloam
