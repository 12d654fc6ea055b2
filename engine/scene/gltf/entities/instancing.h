// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Largest number of nodes of a file, instances included.
inline constexpr std::uint32_t kMaxNodes = 1u << 20;

/// Gives each instance of EXT_mesh_gpu_instancing a node of its own: a child, without a name, that draws the mesh. The
/// new nodes follow those of the file. Appends a warning for an instanced node with a skin, which is drawn once. The
/// document must be checked. Input error with its place: attributes that differ in count or are of a wrong type, a
/// rotation without length, or more than kMaxNodes nodes.
[[nodiscard]] Status expand_instances(Document& document);

}  // namespace gloam::gltf
