// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/log.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace gloam {
namespace {

TEST(Log, every_level_reaches_the_sink_with_its_line) {
  std::vector<std::pair<LogLevel, std::string>> lines;
  FunctionLog log([&](LogLevel level, std::string_view line) { lines.emplace_back(level, line); });
  log.debug("a");
  log.info("b");
  log.warning("c");
  log.error("d");
  const std::vector<std::pair<LogLevel, std::string>> expected = {
      {LogLevel::debug, "a"}, {LogLevel::info, "b"}, {LogLevel::warning, "c"}, {LogLevel::error, "d"}};
  EXPECT_EQ(lines, expected);
}

TEST(Log, the_null_log_takes_lines_and_is_always_the_same) {
  null_log().error("unheard");
  EXPECT_EQ(&null_log(), &null_log());
}

}  // namespace
}  // namespace gloam
