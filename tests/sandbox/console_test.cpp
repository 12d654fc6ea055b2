// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/console.h"

#include <gtest/gtest.h>

#include <string>

namespace gloam {
namespace {

TEST(Console, any_text_becomes_one_line) {
  EXPECT_EQ(one_line("plain"), "plain");
  EXPECT_EQ(one_line("  a\n\tb\r\nc \n"), "a b c");
  EXPECT_EQ(one_line("\n\n"), "");
  EXPECT_EQ(one_line("1…2 é"), "1…2 é");
}

}  // namespace
}  // namespace gloam
