// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/type_table.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/ecs/type_key.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(TypeTable, finds_every_key_it_was_given_and_no_other) {
  const auto key = [](std::uint32_t i) { return static_cast<TypeKey>(0x1000u + i); };
  TypeTable table;
  for (std::uint32_t i = 0; i < 1000; ++i) table.insert(key(i * 2), i);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(table.find(key(i * 2)), i);
    EXPECT_EQ(table.find(key(i * 2 + 1)), TypeTable::kAbsent);
  }
}

TEST(TypeTable, refuses_a_key_twice) {
  TypeTable table;
  table.insert(type_key<int>(), 1);
  EXPECT_ASSERT(table.insert(type_key<int>(), 2), "entered into a table once");
}

template <class T>
std::uint32_t found(const TypeCache& cache) {
  return cache.find_or<T>([] { return TypeTable::kAbsent; });
}

TEST(TypeCache, finds_what_it_holds_while_it_is_on) {
  TypeCache cache;
  EXPECT_EQ(found<int>(cache), TypeTable::kAbsent);
  cache.insert(type_key<int>(), detail::kTypeNameHash<int>, 7);
  EXPECT_EQ(found<int>(cache), 7u);
  EXPECT_EQ(found<float>(cache), TypeTable::kAbsent);
  cache.set_on(false);
  EXPECT_EQ(found<int>(cache), TypeTable::kAbsent);
  cache.insert(type_key<float>(), detail::kTypeNameHash<float>, 8);
  EXPECT_EQ(found<float>(cache), TypeTable::kAbsent);
  cache.set_on(true);
  EXPECT_EQ(found<int>(cache), 7u);
  EXPECT_EQ(found<float>(cache), 8u);
}

TEST(TypeCache, keeps_the_first_of_types_that_share_a_place) {
  TypeCache cache;
  cache.insert(type_key<int>(), detail::kTypeNameHash<int>, 7);
  cache.insert(type_key<float>(), detail::kTypeNameHash<int>, 8);
  EXPECT_EQ(found<int>(cache), 7u);
}

struct OfThisFile {};

TypeKey key_of_a_local_type() {
  struct Local {};
  return type_key<Local>();
}

TEST(TypeKey, differs_between_types_of_one_name) {
  struct Local {};
  EXPECT_NE(type_key<Local>(), key_of_a_local_type());
  EXPECT_EQ(type_key<int>(), type_key<int>());
  EXPECT_NE(type_key<int>(), type_key<const int>());
}

// Names that files or functions share are told apart by an address, all others by the name.
TEST(TypeKey, follows_from_the_name_unless_the_name_is_local) {
  struct Local {};
  const auto by_name = [](TypeKey key) { return (static_cast<std::uint64_t>(key) >> 63) == 1; };
  EXPECT_TRUE(by_name(type_key<TypeTable>()));
  EXPECT_TRUE(by_name(type_key<TypeList<TypeTable, const std::vector<int>>>()));
  EXPECT_FALSE(by_name(type_key<Local>()));
  EXPECT_FALSE(by_name(type_key<OfThisFile>()));
  EXPECT_FALSE(by_name(type_key<TypeList<int, OfThisFile>>()));
  EXPECT_FALSE(by_name(type_key<decltype(by_name)>()));
  struct {
  } unnamed;
  EXPECT_FALSE(by_name(type_key<decltype(unnamed)>()));
}

TEST(TypeKey, names_types_for_messages) {
  EXPECT_EQ(type_name<int>(), "int");
  EXPECT_EQ(type_name<TypeTable>(), "gloam::TypeTable");
}

}  // namespace
}  // namespace gloam
