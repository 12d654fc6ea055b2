// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animation.h"
#include "engine/scene/posing/camera_poses.h"
#include "engine/scene/resources.h"
#include "engine/scene/system_state.h"
#include "engine/schedule/schedule.h"

namespace gloam {

/// Adds animation, transform, camera-pose, joint-matrix and morph systems (module "engine", world stage), in that
/// order.
void add_scene_systems(Schedule& schedule);

/// A sentence about a MeshInstance whose mesh is not below `meshes`, the number of meshes of SceneAssets.
[[nodiscard]] std::string absent_mesh(Entity entity, std::uint32_t mesh, std::size_t meshes);

/// Writes the poses at SceneClock's time to LocalTransform. All clips play at once; each loops with its own duration.
void animation_system(View<const SourceNode> sources, View<LocalTransform> poses, Resource<const SceneAssets> assets,
                      Resource<const SceneClock> clock, Resource<SceneNodes> nodes,
                      Resource<AnimationBindings> bindings, JobExecutor& jobs);

/// Computes the WorldTransform of every node. A node with neither LocalTransform nor LocalMatrix gets its parent's
/// matrix; if it has no Parent either, the system keeps the WorldTransform that the host set. A node whose parent is
/// dead or has no WorldTransform is a root. Only nodes whose pose, parent or ancestors have changed since the last call
/// are composed; poses are compared, so that writes to them need no mark_changed. A host that writes the WorldTransform
/// of any other node must mark it as changed, and the system puts it right again.
using TransformView = View<WorldTransform, Maybe<const LocalTransform>, Maybe<const LocalMatrix>, Maybe<const Parent>>;
void transform_system(TransformView nodes, Resource<TransformTree> tree, JobExecutor& jobs);

/// Notes the rigid pose of every camera that has one in this frame.
void camera_pose_system(View<const Camera, const WorldTransform> cameras, Resource<CameraPoses> poses);

/// Computes the JointMatrices of all skinned instances. A joint that is not in the world gets the world matrix of the
/// instance.
void joint_system(View<const MeshInstance> instances, View<const WorldTransform> worlds,
                  Resource<const SceneAssets> assets, Resource<const SceneNodes> nodes, Resource<JointMatrices> joints,
                  JobExecutor& jobs);

/// Gives each MorphInstance its range in MorphWeights and samples the clips that animate the weights.
void morph_system(View<const MeshInstance, MorphInstance> instances, Resource<const SceneAssets> assets,
                  Resource<const SceneClock> clock, Resource<const AnimationBindings> bindings,
                  Resource<MorphWeights> weights);

}  // namespace gloam
