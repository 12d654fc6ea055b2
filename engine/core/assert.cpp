// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/assert.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace gloam {
namespace {

void print_and_abort(const char* condition, std::string_view sentence, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: %.*s (%s)\n", file, line, static_cast<int>(sentence.size()), sentence.data(), condition);
  std::abort();
}

std::atomic<AssertHandler> g_handler = &print_and_abort;  // process-wide: an assertion has no object to store it in

}  // namespace

AssertHandler set_assert_handler(AssertHandler handler) {
  return g_handler.exchange(handler != nullptr ? handler : &print_and_abort);
}

void assert_failed(const char* condition, std::string_view sentence, const char* file, int line) {
  g_handler.load()(condition, sentence, file, line);
  std::abort();
}

}  // namespace gloam
