// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/log.h"

#include <gtest/gtest.h>

#include <string>
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

/// Keeps lines as "category: line".
class SortedLog final : public LogSink {
 public:
  void write(LogLevel level, std::string_view line) override { write_from("none", level, line); }
  void write_from(std::string_view category, LogLevel, std::string_view line) override {
    lines.push_back(std::string(category) + ": " + std::string(line));
  }
  std::vector<std::string> lines;
};

TEST(Log, lines_have_the_category_nearest_to_their_writer) {
  SortedLog log;
  LogCategory render(log, "render");
  LogCategory shadows(render, "shadows");
  log.info("a");
  render.warning("b");
  shadows.warning("c");
  shadows.write_from("lights", LogLevel::info, "d");
  EXPECT_EQ(log.lines, (std::vector<std::string>{"none: a", "render: b", "shadows: c", "lights: d"}));
}

TEST(Log, a_sink_without_categories_gets_the_same_lines) {
  std::vector<std::string> lines;
  FunctionLog log([&](LogLevel, std::string_view line) { lines.emplace_back(line); });
  LogCategory(log, "gpu").error("lost");
  EXPECT_EQ(lines, std::vector<std::string>{"lost"});
}

TEST(Log, the_null_log_takes_lines_and_is_always_the_same) {
  null_log().error("unheard");
  EXPECT_EQ(&null_log(), &null_log());
}

}  // namespace
}  // namespace gloam
