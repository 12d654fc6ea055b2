// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace gloam {

/// Called when an assertion fails; must not return normally (it may throw, which is what tests do).
using AssertHandler = void (*)(const char* condition, std::string_view sentence, const char* file, int line);

/// Replaces the handler of failed assertions; returns the previous one. The default prints one line to standard error
/// and aborts.
AssertHandler set_assert_handler(AssertHandler handler);

[[noreturn]] void assert_failed(const char* condition, std::string_view sentence, const char* file, int line);

}  // namespace gloam

/// Misuse by the programmer: states the rule that was broken in a sentence. Stays on in release builds unless
/// GLOAM_NO_ASSERTS is defined.
#ifdef GLOAM_NO_ASSERTS
#define GLOAM_ASSERT(condition, sentence) ((void)sizeof(condition))
#else
#define GLOAM_ASSERT(condition, sentence) \
  ((condition) ? (void)0 : ::gloam::assert_failed(#condition, (sentence), __FILE__, __LINE__))
#endif
