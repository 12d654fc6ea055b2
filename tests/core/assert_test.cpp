// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/assert.h"

#include <gtest/gtest.h>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(Assert, a_true_condition_runs_on) {
  EXPECT_EQ(test::assertion_of([] { GLOAM_ASSERT(1 + 1 == 2, "sums add up"); }), "(no assertion failed)");
}

TEST(Assert, a_false_condition_hands_its_sentence_to_the_handler) {
  EXPECT_ASSERT(GLOAM_ASSERT(1 + 1 == 3, "sums add up to three"), "add up to three");
}

TEST(Assert, the_condition_is_evaluated_once) {
  int evaluations = 0;
  GLOAM_ASSERT(++evaluations > 0, "counting goes up");
  EXPECT_EQ(evaluations, 1);
}

TEST(Assert, the_handler_learns_condition_file_and_line) {
  struct Seen {};
  static std::string condition;
  static std::string file;
  static int line = 0;
  const AssertHandler previous = set_assert_handler([](const char* c, std::string_view, const char* f, int l) {
    condition = c;
    file = f;
    line = l;
    throw Seen{};
  });
  const int expected_line = __LINE__ + 1;
  EXPECT_THROW(GLOAM_ASSERT(2 < 1, "two is small"), Seen);
  set_assert_handler(previous);
  EXPECT_EQ(condition, "2 < 1");
  EXPECT_THAT(file, testing::EndsWith("assert_test.cpp"));
  EXPECT_EQ(line, expected_line);
}

TEST(Assert, setting_a_handler_returns_the_previous_one) {
  const AssertHandler mine = [](const char*, std::string_view, const char*, int) {};
  const AssertHandler original = set_assert_handler(mine);
  EXPECT_EQ(set_assert_handler(original), mine);
}

TEST(AssertDeathTest, the_default_handler_prints_the_sentence_and_aborts) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_DEATH(
      {
        set_assert_handler(nullptr);
        GLOAM_ASSERT(false, "this never holds");
      },
      "assert_test.cpp:.*: this never holds \\(false\\)");
}

TEST(AssertDeathTest, a_handler_that_returns_still_ends_the_program) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_DEATH(
      {
        set_assert_handler([](const char*, std::string_view, const char*, int) {});
        GLOAM_ASSERT(false, "this never holds");
      },
      "");
}

}  // namespace
}  // namespace gloam
