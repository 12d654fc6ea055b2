// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gloam {

/// Text from a file made fit for one line of a message: control characters become spaces, what is not UTF-8 "?", what
/// exceeds `max_bytes` is cut at a character's end and replaced by "…".
[[nodiscard]] std::string one_line(std::string_view text, std::size_t max_bytes = 80);

/// one_line in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace gloam
