// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gloam {

std::uint64_t hash_bytes(std::span<const std::byte> data) { return XXH3_64bits(data.data(), data.size()); }

}  // namespace gloam
