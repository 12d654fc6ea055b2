// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/plain_text.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(PlainText, stays_on_one_line) {
  EXPECT_EQ(one_line("a\nb\tc\x7f"), "a b c ");
  EXPECT_EQ(in_quotes("torch"), "\"torch\"");
}

TEST(PlainText, is_cut_between_characters) {
  EXPECT_EQ(one_line("abcdef", 6), "abcdef");
  EXPECT_EQ(one_line("abcdefg", 6), "abcdef…");
  EXPECT_EQ(one_line("abcdeäg", 6), "abcde…");
}

TEST(PlainText, replaces_what_is_not_utf8) {
  EXPECT_EQ(one_line("häuser \xe2\x82\xac"), "häuser €");
  EXPECT_EQ(one_line("a\xff\xc3(\xe2\x82"),
            "a?"
            "?(?"
            "?");
}

}  // namespace
}  // namespace gloam
