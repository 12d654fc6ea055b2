// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

struct ImportedMesh {
  Mesh mesh;
  std::uint64_t replaced_normals = 0;  ///< normals that had no length in the file
  std::uint32_t joint_count = 0;       ///< one past the largest joint index with a weight
  std::vector<std::string> warnings;
};

/// Converts one mesh of a checked document to triangle lists with normals. Several may be converted at the same time.
[[nodiscard]] Result<ImportedMesh> import_mesh(const Document& document, std::size_t index);

}  // namespace gloam::gltf
