// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/result.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

Result<int> parse_digit(char c) {
  if (c < '0' || c > '9') return Error{ErrorKind::input, "not a digit"};
  return c - '0';
}

Status check_digits(std::string_view text, int& checked) {
  for (char c : text) {
    GLOAM_TRY(parse_digit(c));
    ++checked;
  }
  return {};
}

TEST(Result, a_value_is_ok_and_readable) {
  const Result<int> seven = parse_digit('7');
  ASSERT_TRUE(seven.ok());
  EXPECT_TRUE(static_cast<bool>(seven));
  EXPECT_EQ(seven.value(), 7);
  EXPECT_EQ(*seven, 7);
}

TEST(Result, an_error_keeps_kind_and_message) {
  const Result<int> bad = parse_digit('x');
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().kind, ErrorKind::input);
  EXPECT_EQ(bad.error().message, "not a digit");
}

TEST(Result, reading_the_wrong_side_asserts) {
  const Result<int> good = parse_digit('1');
  const Result<int> bad = parse_digit('x');
  EXPECT_ASSERT((void)bad.value(), "holds an error has no value");
  EXPECT_ASSERT((void)*bad, "holds an error has no value");
  EXPECT_ASSERT((void)parse_digit('y').value(), "holds an error has no value");
  EXPECT_ASSERT((void)good.error(), "holds a value has no error");
}

TEST(Result, moves_values_that_cannot_be_copied) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(5));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 5);
}

TEST(Result, arrow_reaches_into_the_value) {
  Result<std::string> text(std::string("dusk"));
  text->push_back('!');
  EXPECT_EQ(text.value(), "dusk!");
}

TEST(Result, a_status_is_ok_by_default) {
  const Status status;
  EXPECT_TRUE(status.ok());
}

TEST(Result, try_leaves_with_the_error_at_the_first_fault) {
  int checked = 0;
  const Status status = check_digits("12x4", checked);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "not a digit");
  EXPECT_EQ(checked, 2);
}

TEST(Result, try_runs_on_when_all_is_well) {
  int checked = 0;
  EXPECT_TRUE(check_digits("1234", checked).ok());
  EXPECT_EQ(checked, 4);
}

TEST(Result, try_stands_in_a_brace_less_if) {
  const auto function = [](bool check) -> Status {
    if (check)
      GLOAM_TRY(parse_digit('x'));
    else
      return {};
    return {};
  };
  EXPECT_FALSE(function(true).ok());
  EXPECT_TRUE(function(false).ok());
}

}  // namespace
}  // namespace gloam
