// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace gloam {

/// Least number of edits that turn one spelling into the other: inserting, deleting or replacing a byte, or swapping
/// two neighbours (optimal string alignment: no byte is edited twice). The case of ASCII letters does not count.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name closest in spelling to `wanted`, the first of equally close ones; refers to an item of `names`. Empty if
/// every name needs more than min(n / 3, 2 + n / 8) edits (n: bytes of the longer of the two spellings), or if `wanted`
/// exceeds 100 bytes.
[[nodiscard]] std::string_view nearest_name(std::string_view wanted, std::span<const std::string> names);

/// "did you mean NAME? " with the nearest name, to be put before the list of valid names. Empty if there is no nearest
/// name.
[[nodiscard]] std::string did_you_mean(std::string_view wanted, std::span<const std::string> names);

/// "did you mean b? there are a, b, c", for the end of a sentence about an unknown name; without the question if there
/// is no nearest name. "there are none" if `names` is empty.
[[nodiscard]] std::string valid_names(std::string_view wanted, std::span<const std::string> names);

}  // namespace gloam
