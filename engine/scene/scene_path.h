// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

/// The path of a file that a scene names. `uri` is relative to the scene's folder and may be percent-encoded. Refused:
/// absolute paths, other schemes, and what would leave the folder, encoded or not. The error is the fault alone.
[[nodiscard]] Result<std::string> resolve_scene_path(const std::string& directory, std::string_view uri);

/// The whole of a regular file, or its first `wanted_bytes` (a shorter file is a fault). The error is the fault alone.
[[nodiscard]] Result<std::vector<std::uint8_t>> read_scene_file(const std::string& path,
                                                                std::uint64_t wanted_bytes = ~std::uint64_t{0});

}  // namespace gloam
