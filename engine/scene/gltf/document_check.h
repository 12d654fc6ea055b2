// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Bytes of one element's component.
[[nodiscard]] std::uint64_t component_size(ComponentType type);

/// Buffer views inside their buffers, accessors inside their views, kinds and counts of what primitives and skins name.
/// What it passes can be read without a further look at a bound. Indices into the document's arrays must be in range
/// already. file_bytes: of the scene file itself; it and the buffers justify how much memory the meshes may take.
[[nodiscard]] Status check_document(const Document& document, std::uint64_t file_bytes);

/// Finds every node's parent, refuses cycles and second parents, and checks the scenes' roots. Does not recurse.
[[nodiscard]] Status check_node_tree(Document& document);

}  // namespace gloam::gltf
