// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gloam {

/// Most levels of arrays and objects in JSON that gloam reads. nlohmann::json copies, compares and prints values by
/// recursion: a text of 200,000 brackets would exhaust the stack.
inline constexpr std::size_t kMostJsonLevels = 96;

/// Whether a JSON text has more than kMostJsonLevels levels. Brackets in strings do not count. Any answer is possible
/// for text that is no JSON; the parser refuses that.
[[nodiscard]] bool nests_too_deep(std::string_view json);

/// The fault of a text that nests_too_deep(): "is nested deeper than 96 levels".
[[nodiscard]] std::string too_deep_text();

}  // namespace gloam
