// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Decompresses the buffer views of EXT_meshopt_compression: each gets a buffer of its own, behind those of the file.
/// file_bytes: size of the scene file. Input error with its place: a range outside its buffer, an element size that the
/// format does not allow, damaged content, or more decoded bytes than the files justify.
[[nodiscard]] Status decompress_views(Document& document, std::uint64_t file_bytes);

}  // namespace gloam::gltf
