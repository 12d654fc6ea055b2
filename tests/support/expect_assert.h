// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <string_view>

#include "engine/core/assert.h"

namespace gloam::test {

/// The exception that the throwing handler throws. Not a std::exception, so that code under test does not swallow it by
/// accident.
struct AssertionFailed {
  std::string sentence;
};

/// During its lifetime a failed assertion throws AssertionFailed. The handler is process-wide: use these objects on one
/// thread.
class ThrowingAsserts {
 public:
  ThrowingAsserts() : previous_(set_assert_handler(&throw_sentence)) {}
  ~ThrowingAsserts() { set_assert_handler(previous_); }
  ThrowingAsserts(const ThrowingAsserts&) = delete;
  ThrowingAsserts& operator=(const ThrowingAsserts&) = delete;

 private:
  [[noreturn]] static void throw_sentence(const char*, std::string_view sentence, const char*, int) {
    throw AssertionFailed{std::string(sentence)};
  }
  AssertHandler previous_;
};

/// Runs `body` and returns the sentence of the assertion that failed, or "(no assertion failed)".
template <class Body>
[[nodiscard]] std::string assertion_of(Body&& body) {
  const ThrowingAsserts throwing;
  try {
    body();
  } catch (const AssertionFailed& failed) {
    return failed.sentence;
  }
  return "(no assertion failed)";
}

}  // namespace gloam::test

/// Expects that `statement` fails an assertion whose sentence contains `substring`. The assertion must fail on the
/// calling thread and outside noexcept functions and destructors. Discard values with (void); wrap commas in
/// parentheses.
#define EXPECT_ASSERT(statement, substring) \
  EXPECT_THAT(::gloam::test::assertion_of([&] { statement; }), ::testing::HasSubstr(substring))
