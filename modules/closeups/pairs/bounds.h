// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/scene/caster_bounds.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"

namespace gloam {

/// Of meshes that deform, what bounds their poses; a resource. Primitives have only bounds, flags and counts of
/// targets.
struct CloseupMeshes {
  std::uint64_t version = 0;                        ///< of the SceneAssets it was made from; 0: of none
  std::vector<std::vector<GpuPrimitive>> deformed;  ///< by mesh; empty for one that is rigid
};

/// Makes it anew when it is not of this version.
void update_closeup_meshes(const SceneAssets& assets, JobExecutor& jobs, CloseupMeshes& meshes);

/// What the boxes of instances are made from in one frame.
struct PosedScene {
  const SceneAssets& assets;
  const CloseupMeshes& meshes;
  const JointMatrices& joints;
  const MorphWeights& weights;
};

/// Box of several instances.
struct BoxSum {
  WorldBox box;
  bool unknown = false;  ///< one of them may be anywhere
  void add(const WorldBox& other) {
    box.min = glm::min(box.min, other.min);
    box.max = glm::max(box.max, other.max);
  }
  void add(const BoxSum& other) {
    add(other.box);
    unknown = unknown || other.unknown;
  }
};

/// Adds what an instance draws, morphed and posed. One without a mesh draws nothing. `morph`: null without weights.
void add_posed(const PosedScene& scene, Entity entity, const MeshInstance& instance, const dmat4& world_from_node,
               const MorphInstance* morph, BoxSum& sum);

}  // namespace gloam
