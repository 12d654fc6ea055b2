// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Size of one component in bytes; 0 if glTF does not define the type.
[[nodiscard]] std::uint64_t component_size(ComponentType type);

/// Bytes of the scene file and of the buffers that it names.
[[nodiscard]] std::uint64_t bytes_read(const Document& document, std::uint64_t file_bytes);
/// Bytes of memory that the import may take for buffers, meshes, skins and animations of files of this size.
[[nodiscard]] std::uint64_t import_budget(std::uint64_t bytes_read);

/// Checks that buffer views lie inside their buffers and accessors inside their views, and that the accessors of
/// primitives and skins have the right types and counts. After success, all elements can be read without bounds checks.
/// Indices into the document's arrays must be in range already. file_bytes: size of the scene file; it and the sizes of
/// the buffers limit the memory that meshes, skins and animations may take.
[[nodiscard]] Status check_document(const Document& document, std::uint64_t file_bytes);

/// Sets every node's parent. Input error: a cycle, a node with two parents, a scene that lists a child node or one node
/// twice, or weights that do not match the mesh's morph targets. Does not recurse.
[[nodiscard]] Status check_node_tree(Document& document);

}  // namespace gloam::gltf
