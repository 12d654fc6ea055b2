// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <random>
#include <span>
#include <string>

#include "tests/fuzz/target.h"

namespace gloam::fuzz {

using Random = std::mt19937_64;

/// A seed with one to four random changes. Half of the results keep their form: numbers and words of texts are
/// replaced, and bytes of buffers flipped. In the other half inputs are cut short, bytes flipped anywhere, pieces
/// swapped, copied or removed, and words and pieces of other seeds put in; some keep the chunk lengths of a .glb right.
/// The first `fixed` bytes stay. Seeds are not empty. The same generator state gives the same result.
[[nodiscard]] Bytes mutate(std::span<const Bytes> seeds, std::span<const std::string> words, std::size_t fixed,
                           Random& random);

}  // namespace gloam::fuzz
