// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <string>

#include "engine/core/result.h"
#include "engine/core/text/plain_text.h"

namespace gloam {

/// Runs `body`, which returns a Status. An exception derived from std::exception becomes an error: "PLACE failed:
/// TEXT", where `place` returns PLACE. It is called after the exception. Other exceptions (a failed assertion of a
/// test, the cancellation of a thread) pass through.
template <class Place, class Body>
[[nodiscard]] Status attempt(const Place& place, const Body& body) {
  constexpr std::size_t kMost = 1000;  // bytes of the text
  try {
    return body();
  } catch (const std::exception& exception) {
    return Error{ErrorKind::failed, place() + " failed: " + one_line(exception.what(), kMost)};
  }
}

}  // namespace gloam
