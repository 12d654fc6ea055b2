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

/// Where anything is that a subject's shadow of a directional light may fall on; a resource. Made only while there are
/// a subject and such a light, else not known.
struct CloseupReceivers {
  WorldBox box;
};

using PosedMeshes = View<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>;

/// Finds subjects, what belongs to each, and where it is. One with a part that may be anywhere has no box.
void closeup_subjects_system(View<const CloseupSubject> subjects, PosedMeshes meshes, View<const Parent> parents,
                             Resource<const SceneAssets> assets, Resource<const JointMatrices> joints,
                             Resource<const MorphWeights> weights, Resource<CloseupMeshes> bounds,
                             Resource<CloseupSubjects> found, JobExecutor& jobs);

void closeup_receivers_system(View<const Light> lights, PosedMeshes meshes, Resource<const SceneAssets> assets,
                              Resource<const JointMatrices> joints, Resource<const MorphWeights> weights,
                              Resource<const CloseupMeshes> bounds, Resource<const CloseupSubjects> subjects,
                              Resource<CloseupReceivers> receivers, JobExecutor& jobs);

}  // namespace gloam
