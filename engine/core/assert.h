// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace gloam {

/// Called when an assertion fails. It must not return normally; it may throw, as the tests' handler does.
using AssertHandler = void (*)(const char* condition, std::string_view sentence, const char* file, int line);

/// Replaces the handler of failed assertions and returns the previous one. The default handler, which nullptr restores,
/// prints one line to standard error and aborts.
AssertHandler set_assert_handler(AssertHandler handler);

[[noreturn]] void assert_failed(const char* condition, std::string_view sentence, const char* file, int line);

}  // namespace gloam

/// Checks for misuse by the programmer. `sentence` states the rule that was broken; it is evaluated only on failure.
/// Stays on in release builds unless GLOAM_NO_ASSERTS is defined.
#ifdef GLOAM_NO_ASSERTS
#define GLOAM_ASSERT(condition, sentence) ((void)sizeof(condition))
#else
#define GLOAM_ASSERT(condition, sentence) \
  ((condition) ? (void)0 : ::gloam::assert_failed(#condition, (sentence), __FILE__, __LINE__))
#endif
