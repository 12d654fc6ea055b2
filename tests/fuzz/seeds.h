// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace gloam::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Small sound scene files, .gltf and .glb, that together use every part of the loader.
[[nodiscard]] std::vector<Bytes> seeds();

}  // namespace gloam::fuzz
