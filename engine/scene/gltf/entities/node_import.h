// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/document.h"
#include "engine/scene/gltf/entities/poses.h"

namespace gloam::gltf {

/// Creates one entity per node of the scene, in node order, with its pose, mesh, camera and names. The world must be
/// prepared (prepare_scene_world). joint_counts: ImportedMesh::joint_count by mesh. Returns the entities by node,
/// kNoEntity for nodes outside the scene.
[[nodiscard]] Result<std::vector<Entity>> import_nodes(Document& document, const SceneNodeOrder& nodes,
                                                       std::span<const std::uint32_t> joint_counts, World& world);

}  // namespace gloam::gltf
