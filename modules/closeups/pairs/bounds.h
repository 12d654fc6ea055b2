// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"

namespace gloam {

/// Bounds of the poses of meshes that deform; a resource. In the primitives only bounds, `skinned` and the number of
/// morph targets are set.
struct CloseupMeshes {
  std::uint64_t version = 0;                        ///< SceneAssets::version it was computed from; 0: none
  std::uint64_t revision = 0;                       ///< SceneAssets::revision() it was computed from
  std::vector<std::vector<GpuPrimitive>> deformed;  ///< by mesh; empty for a rigid mesh
};

/// Recomputes what has changed in `assets` since `meshes` was computed.
void update_closeup_meshes(const SceneAssets& assets, JobExecutor& jobs, CloseupMeshes& meshes);

/// Inputs for the boxes of mesh instances in one frame.
struct PosedScene {
  const SceneAssets& assets;
  const CloseupMeshes& meshes;
  const JointMatrices& joints;
  const MorphWeights& weights;
};

/// Union of the boxes of several instances.
struct BoxSum {
  WorldBox box;
  bool unknown = false;  ///< the box of at least one instance is unknown
  void add(const WorldBox& other) {
    box.min = glm::min(box.min, other.min);
    box.max = glm::max(box.max, other.max);
  }
  void add(const BoxSum& other) {
    add(other.box);
    unknown = unknown || other.unknown;
  }
};

/// Adds the world box of an instance, morphed and posed. An instance without a mesh adds nothing. `morph`: null if the
/// instance has no weights.
void add_posed(const PosedScene& scene, Entity entity, const MeshInstance& instance, const dmat4& world_from_node,
               const MorphInstance* morph, BoxSum& sum);

}  // namespace gloam
