// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/json_nesting.h"

#include <gtest/gtest.h>

#include <string>

namespace gloam {
namespace {

std::string nested(std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

TEST(JsonNesting, counts_levels_of_arrays_and_objects) {
  EXPECT_FALSE(nests_too_deep(""));
  EXPECT_FALSE(nests_too_deep(nested(kMostJsonLevels)));
  EXPECT_TRUE(nests_too_deep(nested(kMostJsonLevels + 1)));
  EXPECT_TRUE(nests_too_deep(R"({"a":)" + nested(kMostJsonLevels) + "}"));
  EXPECT_FALSE(nests_too_deep("[" + nested(kMostJsonLevels - 1) + "," + nested(kMostJsonLevels - 1) + "]"));
}

TEST(JsonNesting, does_not_count_brackets_in_strings) {
  const std::string brackets(kMostJsonLevels + 1, '[');
  EXPECT_FALSE(nests_too_deep("\"" + brackets + "\""));
  EXPECT_FALSE(nests_too_deep(R"("\")" + brackets + "\"")) << "an escaped quote does not end the string";
  EXPECT_TRUE(nests_too_deep(R"("\\")" + brackets)) << "an escaped backslash does not escape the quote after it";
}

TEST(JsonNesting, looks_at_the_whole_of_a_text_that_closes_too_much) {
  EXPECT_TRUE(nests_too_deep("]]]]" + nested(kMostJsonLevels + 1)));
}

}  // namespace
}  // namespace gloam
