// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/json_writer.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(JsonWriter, what_it_writes_reads_back) {
  JsonWriter json;
  json.begin_object().key("text").text("a \"b\" \\ \n \x01 é").key("whole").integer(-42).key("number").number(0.1);
  json.key("yes")
      .boolean(true)
      .key("none")
      .null()
      .key("empty")
      .begin_array()
      .end_array()
      .key("also")
      .begin_object()
      .end_object();
  json.key("list")
      .begin_array()
      .integer(1)
      .begin_object()
      .key("x")
      .number(1e300)
      .end_object()
      .text("")
      .end_array()
      .end_object();
  const auto read = nlohmann::json::parse(json.finish());
  EXPECT_EQ(read["text"], "a \"b\" \\ \n \x01 é");
  EXPECT_EQ(read["whole"], -42);
  EXPECT_EQ(read["number"], 0.1);
  EXPECT_EQ(read["yes"], true);
  EXPECT_TRUE(read["none"].is_null());
  EXPECT_TRUE(read["empty"].is_array());
  EXPECT_TRUE(read["also"].is_object());
  EXPECT_EQ(read["list"][1]["x"], 1e300);
  EXPECT_EQ(read["list"].size(), 3u);
}

TEST(JsonWriter, numbers_json_has_no_word_for_become_null) {
  JsonWriter json;
  json.begin_array()
      .number(std::numeric_limits<double>::quiet_NaN())
      .number(std::numeric_limits<double>::infinity())
      .end_array();
  const auto read = nlohmann::json::parse(json.finish());
  EXPECT_TRUE(read[0].is_null());
  EXPECT_TRUE(read[1].is_null());
}

TEST(JsonWriter, misuse_asserts) {
  EXPECT_ASSERT(JsonWriter().begin_object().integer(1), "follows its key");
  EXPECT_ASSERT(JsonWriter().begin_array().key("a"), "a key stands in an object");
  EXPECT_ASSERT(JsonWriter().begin_array().end_object(), "innermost");
  EXPECT_ASSERT((void)JsonWriter().begin_array().finish(), "ended");
}

}  // namespace
}  // namespace gloam
