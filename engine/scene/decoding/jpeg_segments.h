// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"

namespace gloam {

/// Number of scans of a JPEG, 1 if it has none. Input error if a Huffman table has more than 256 codes, for which
/// stb_image has no room. file: begins with a JPEG's first marker. The message holds only the fault, not the place.
[[nodiscard]] Result<std::uint32_t> count_jpeg_scans(std::span<const std::uint8_t> file);

}  // namespace gloam
