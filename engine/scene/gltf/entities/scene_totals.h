// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "engine/scene/gltf/document.h"
#include "engine/scene/gltf/entities/poses.h"

namespace gloam::gltf {

// Limits keep every index in 32 bits and every storage buffer that a frame binds in 128 MiB, the least that Vulkan
// guarantees, also if a frame deforms vertices for the previous pose too.
inline constexpr std::uint64_t kMaxPrimitiveVertices = std::uint64_t{1} << 23;  ///< influences take 16 bytes each
inline constexpr std::uint64_t kMaxPrimitiveIndices = (std::uint64_t{1} << 25) - 64;
inline constexpr std::uint64_t kMaxMorphFloats = std::uint64_t{1} << 25;  ///< of one primitive: vertices · targets · 6
inline constexpr std::uint64_t kMaxJoints = std::uint64_t{1} << 20;       ///< of all skinned nodes
inline constexpr std::uint64_t kMaxMorphWeights = std::uint64_t{1} << 22;
inline constexpr std::uint64_t kMaxDeformedVertices = std::uint64_t{1} << 24;
inline constexpr std::uint64_t kMaxDrawnPrimitives = std::uint64_t{1} << 21;
inline constexpr std::uint64_t kMaxDrawnTriangles = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMaxAssetItems = std::uint64_t{1}
                                                << 31;  ///< vertices, indices, morph floats of all meshes

/// Compares the sizes of the imported meshes, and their sums over the nodes of the scene, with the limits above. Any
/// number of nodes may draw one mesh or follow one skin, so that a small file can ask for gigantic sums. joint_counts:
/// ImportedMesh::joint_count by mesh. Input error with its place.
[[nodiscard]] Status check_scene_totals(const Document& document, const SceneNodeOrder& nodes,
                                        std::span<const std::uint32_t> joint_counts, std::span<const Mesh> meshes);

}  // namespace gloam::gltf
