// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <span>

#include "tests/fuzz/seeds.h"

namespace gloam::fuzz {

using Random = std::mt19937_64;

/// A seed with one to four random changes. Half of the results keep their form: numbers of the JSON are replaced and
/// bytes of the buffer flipped. In the other half files are cut short, bytes flipped anywhere, pieces swapped, copied
/// or removed, and pieces of other seeds put in; some keep the chunk lengths of a .glb right. The same generator state
/// gives the same result.
[[nodiscard]] Bytes mutate(std::span<const Bytes> seeds, Random& random);

}  // namespace gloam::fuzz
