// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/view.h"
#include "engine/schedule/schedule.h"
#include "modules/closeups/components.h"
#include "modules/closeups/pairs/bounds.h"
#include "modules/closeups/pairs/views.h"
#include "modules/lights/components.h"

namespace gloam {

/// Box of everything that may receive a subject's shadow from a directional light; a resource. Known only while the
/// world has a subject with a known box and a directional light.
struct CloseupReceivers {
  WorldBox box;
};

using PosedMeshes = View<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>;

/// Finds the enabled subjects, their casters and their boxes. A subject has no box if the box of one of its casters is
/// unknown.
void closeup_subjects_system(View<const CloseupSubject> subjects, PosedMeshes meshes, View<const Parent> parents,
                             Resource<const SceneAssets> assets, Resource<const JointMatrices> joints,
                             Resource<const MorphWeights> weights, Resource<CloseupMeshes> bounds,
                             Resource<CloseupSubjects> found, JobExecutor& jobs);

/// Computes CloseupReceivers.
void closeup_receivers_system(View<const Light> lights, PosedMeshes meshes, Resource<const SceneAssets> assets,
                              Resource<const JointMatrices> joints, Resource<const MorphWeights> weights,
                              Resource<const CloseupMeshes> bounds, Resource<const CloseupSubjects> subjects,
                              Resource<CloseupReceivers> receivers, JobExecutor& jobs);

}  // namespace gloam
