// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/json_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace gloam {
namespace {

TEST(JsonText, keys_keep_their_order) {
  EXPECT_EQ(json_text({{"b", 1}, {"a", Json::array()}, {"c", Json::object()}}),
            "{\n  \"b\": 1,\n  \"a\": [],\n  \"c\": {}\n}\n");
}

TEST(JsonText, numbers_that_json_cannot_express_become_null) {
  EXPECT_EQ(
      json_text({{"a", std::numeric_limits<double>::quiet_NaN()}, {"b", std::numeric_limits<double>::infinity()}}),
      "{\n  \"a\": null,\n  \"b\": null\n}\n");
}

TEST(JsonText, bytes_that_are_not_utf_8_are_replaced) {
  EXPECT_EQ(json_text("é \xff \"q\" \x01"), "\"é \xef\xbf\xbd \\\"q\\\" \\u0001\"\n");
}

}  // namespace
}  // namespace gloam
