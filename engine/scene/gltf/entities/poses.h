// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Normalises rotations and converts matrices that are translation · rotation · scale to poses. A node keeps its matrix
/// only if the matrix shears or scales an axis to zero.
[[nodiscard]] Status resolve_poses(Document& document);

/// The nodes of one scene of a checked document.
struct SceneNodeOrder {
  std::uint32_t scene = kNone;       ///< kNone: the file has no scenes, all roots are used
  std::vector<std::uint32_t> order;  ///< parents before children
  std::vector<bool> used;            ///< by node: whether it belongs to the scene
  std::vector<std::uint32_t> depth;  ///< by node; 0: root
};

/// wanted: index of a scene, or −1 for the file's default scene, else its first. Usage error if it does not exist.
[[nodiscard]] Result<SceneNodeOrder> select_scene(const Document& document, int wanted);

/// World matrices by node, composed in double; identity for unused nodes. Input error if a value is not finite in
/// float.
[[nodiscard]] Result<std::vector<dmat4>> compose_node_worlds(const Document& document, const SceneNodeOrder& nodes);

}  // namespace gloam::gltf
