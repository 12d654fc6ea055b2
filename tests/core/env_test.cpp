// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/env.h"

#include <gtest/gtest.h>

#include "tests/support/environment.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

/// Sets an environment variable for its lifetime; the destructor restores the previous value.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name), before_(environment_text(name)) {
    test::set_environment(name, value);
  }
  ~Variable() { test::set_environment(name_, before_ ? before_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

constexpr const char* kName = "GLOAM_ENV_TEST";

TEST(Env, an_absent_or_empty_variable_is_nothing) {
  EXPECT_EQ(environment_text(kName), std::nullopt);
  EXPECT_EQ(environment_number(kName), std::nullopt);
  const Variable empty(kName, "");
  EXPECT_EQ(environment_text(kName), std::nullopt);
  EXPECT_EQ(environment_number(kName), std::nullopt);
}

TEST(Env, text_comes_back_as_it_is) {
  const Variable variable(kName, " two words ");
  EXPECT_EQ(environment_text(kName), " two words ");
}

TEST(Env, a_number_is_read_and_anything_else_is_nothing) {
  for (const auto& [text, number] : {std::pair{"2.5", 2.5}, {"-3", -3.0}, {"1e3", 1000.0}}) {
    const Variable variable(kName, text);
    EXPECT_EQ(environment_number(kName), number) << text;
  }
  for (const char* text : {"two", "2x", " 2", "2 ", "1e999", "--1"}) {
    const Variable variable(kName, text);
    EXPECT_EQ(environment_number(kName), std::nullopt) << text;
  }
}

TEST(Scale, multiplies_counts_and_never_reaches_zero) {
  {
    const Variable scale("GLOAM_TEST_SCALE", "2.5");
    EXPECT_EQ(test::scaled(100), 250);
  }
  {
    const Variable scale("GLOAM_TEST_SCALE", "0.001");
    EXPECT_EQ(test::scaled(100), 1);
  }
  for (const char* text : {"", "much", "0", "-1", "inf", "nan"}) {
    const Variable scale("GLOAM_TEST_SCALE", text);
    EXPECT_EQ(test::scaled(100), 100) << text;
  }
}

}  // namespace
}  // namespace gloam
