// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"

namespace gloam::gltf {

/// Normalises rotations; turns matrices that are translation · rotation · scale into poses. What keeps its matrix is
/// sheared.
[[nodiscard]] Status resolve_poses(Document& document);

/// The nodes of one scene of a checked document.
struct SceneNodeOrder {
  std::uint32_t scene = kNone;       ///< kNone: the file has no scenes, all roots are taken
  std::vector<std::uint32_t> order;  ///< parents before children
  std::vector<bool> used;            ///< by node
  std::vector<std::uint32_t> depth;  ///< by node; 0: root
};

/// wanted: a scene's index, or −1 for the file's own choice. A wanted scene that is not there is a usage error.
[[nodiscard]] Result<SceneNodeOrder> select_scene(const Document& document, int wanted);

/// Node to world by node, in double; identity where not used. A transform that is not finite in float is a fault.
[[nodiscard]] Result<std::vector<dmat4>> compose_node_worlds(const Document& document, const SceneNodeOrder& nodes);

}  // namespace gloam::gltf
