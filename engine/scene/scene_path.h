// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

/// Path of a file that a scene names. `uri` is relative to the scene's folder `directory` and may be percent-encoded.
/// Spellings that differ only in "." and ".." give the same path.
/// Input error if it is empty, absolute, has a scheme, holds a zero byte or leaves the folder, encoded or not. The
/// message holds only the fault, not the place.
[[nodiscard]] Result<std::string> resolve_scene_path(const std::string& directory, std::string_view uri);

/// Reads a whole regular file, or its first `wanted_bytes`. Input error if the file is absent, not regular, or shorter
/// than `wanted_bytes`. The message holds only the fault, not the place.
[[nodiscard]] Result<std::vector<std::uint8_t>> read_scene_file(const std::string& path,
                                                                std::uint64_t wanted_bytes = ~std::uint64_t{0});

}  // namespace gloam
