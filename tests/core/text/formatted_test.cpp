// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/formatted.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <string>

#include "tests/support/comma_locale.h"

namespace gloam {
namespace {

TEST(Formatted, prints_what_printf_prints) {
  EXPECT_EQ(formatted("%d %s %.3f %g", 7, "seven", 7.5, 1e-9), "7 seven 7.500 1e-09");
  EXPECT_EQ(formatted("%s", std::string(5000, 'x').c_str()), std::string(5000, 'x'));
  EXPECT_EQ(formatted("%s", ""), "");
}

TEST(Formatted, has_decimal_points_in_every_locale) {
  const test::CommaLocale locale;
  if (!locale.is_set()) GTEST_SKIP() << "no locale with decimal commas can be made on this machine";
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", 1.25);
  ASSERT_STREQ(text, "1,25") << "the locale is in force";
  EXPECT_EQ(formatted("%.2f %g", 1.25, 0.5), "1.25 0.5");
  std::snprintf(text, sizeof(text), "%.2f", 1.25);
  EXPECT_STREQ(text, "1,25") << "and still is";
}

}  // namespace
}  // namespace gloam
