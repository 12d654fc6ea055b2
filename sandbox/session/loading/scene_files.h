// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace gloam {

/// Hash of a scene's file and of the buffers and images that it names, as they are on the disk now. Files that cannot
/// be read count as absent. 0 for a built-in scene.
[[nodiscard]] std::uint64_t scene_files_hash(const std::string& scene);

}  // namespace gloam
