// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace gloam::gpu::spirv {

/// A compute shader whose loop holds `count` ifs with an else in a row, each of which depends on what the one before
/// has stored. How long a compiler takes for it says whether it walks all 2^count paths. One storage buffer, set 0,
/// binding 0.
[[nodiscard]] std::vector<std::uint32_t> many_selections(std::uint32_t count);

}  // namespace gloam::gpu::spirv
