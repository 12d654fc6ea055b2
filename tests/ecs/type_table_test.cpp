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
  std::vector<char> keys(2000);
  TypeTable table;
  for (std::uint32_t i = 0; i < 1000; ++i) table.insert(&keys[i * 2], i);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(table.find(&keys[i * 2]), i);
    EXPECT_EQ(table.find(&keys[i * 2 + 1]), TypeTable::kAbsent);
  }
}

TEST(TypeTable, refuses_a_key_twice) {
  TypeTable table;
  table.insert(&table, 1);
  EXPECT_ASSERT(table.insert(&table, 2), "entered into a table once");
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
  const int other = 0;
  cache.insert(type_key<int>(), detail::kTypeNameHash<int>, 7);
  cache.insert(&other, detail::kTypeNameHash<int>, 8);
  EXPECT_EQ(found<int>(cache), 7u);
}

const void* key_of_a_local_type() {
  struct Local {};
  return type_key<Local>();
}

TEST(TypeKey, differs_between_types_of_one_name) {
  struct Local {};
  EXPECT_NE(type_key<Local>(), key_of_a_local_type());
  EXPECT_EQ(type_key<int>(), type_key<int>());
  EXPECT_NE(type_key<int>(), type_key<const int>());
}

TEST(TypeKey, names_types_for_messages) {
  EXPECT_EQ(type_name<int>(), "int");
  EXPECT_EQ(type_name<TypeTable>(), "gloam::TypeTable");
}

}  // namespace
}  // namespace gloam
