// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Decompresses the primitives of KHR_draco_mesh_compression. Each attribute that the importer reads, and the indices,
/// get an accessor, a view and a buffer behind those of the file, and the primitive refers to them instead; it is then
/// a list of triangles. Call it after decompress_views and before check_document. file_bytes: size of the scene file.
/// Input error with its place: a damaged stream, counts, ids or component types that differ from those of the
/// accessors, values that are not finite, or more decoded bytes than the files justify.
[[nodiscard]] Status decompress_meshes(Document& document, std::uint64_t file_bytes);

}  // namespace gloam::gltf
