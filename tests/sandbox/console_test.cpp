// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/console.h"

#include <gtest/gtest.h>

#include <string>

namespace gloam {
namespace {

TEST(Console, any_text_becomes_one_line) {
  EXPECT_EQ(joined_lines("plain"), "plain");
  EXPECT_EQ(joined_lines("  a\n\tb\r\nc \n"), "a b c");
  EXPECT_EQ(joined_lines("\n\n"), "");
  EXPECT_EQ(joined_lines("1…2 é"), "1…2 é");
}

}  // namespace
}  // namespace gloam
