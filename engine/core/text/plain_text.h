// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gloam {

/// Makes text from a file fit for one line of a message. Control characters become spaces, bytes that are not UTF-8
/// become "?", and text beyond `max_bytes` is cut at the end of a character and replaced by "…".
[[nodiscard]] std::string one_line(std::string_view text, std::size_t max_bytes = 80);

/// one_line(text) in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace gloam
