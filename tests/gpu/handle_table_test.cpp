// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/handle_table.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/gpu/types.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

using Table = HandleTable<std::string, BufferHandle>;

TEST(HandleTable, finds_what_was_inserted) {
  Table table;
  const BufferHandle a = table.insert("a");
  const BufferHandle b = table.insert("b");
  EXPECT_TRUE(a);
  EXPECT_NE(a, b);
  EXPECT_EQ(table.get(a), "a");
  EXPECT_EQ(table.get(b), "b");
}

TEST(HandleTable, a_handle_is_stale_after_its_object_was_removed) {
  Table table;
  const BufferHandle a = table.insert("a");
  EXPECT_EQ(table.remove(a), "a");
  const BufferHandle b = table.insert("b");
  EXPECT_EQ(b.index, a.index);
  EXPECT_FALSE(table.alive(a));
  EXPECT_TRUE(table.alive(b));
  EXPECT_ASSERT((void)table.get(a), "alive");
  EXPECT_ASSERT((void)table.remove(a), "once");
  EXPECT_ASSERT((void)table.get(BufferHandle()), "alive");
}

TEST(HandleTable, references_stay_good_while_the_table_grows) {
  Table table;
  const std::string& first = table.get(table.insert("first"));
  for (int i = 0; i < 1000; ++i) (void)table.insert("more");
  EXPECT_EQ(first, "first");
}

TEST(HandleTable, hands_back_everything_that_is_left) {
  Table table;
  const BufferHandle a = table.insert("a");
  (void)table.insert("b");
  (void)table.remove(a);
  (void)table.insert("c");
  int count = 0;
  table.for_each([&](const std::string&) { ++count; });
  EXPECT_EQ(count, 2);
  EXPECT_EQ(table.remove_all(), (std::vector<std::string>{"c", "b"}));
}

}  // namespace
}  // namespace gloam::gpu
