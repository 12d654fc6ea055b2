// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/system_state.h"

#include "engine/scene/posing/animation.h"
#include "engine/scene/posing/camera_poses.h"

namespace gloam {

void prepare_scene_systems(World& world) {
  world.ensure_resource<SceneNodes>();
  world.ensure_resource<AnimationBindings>();
  world.ensure_resource<TransformTree>();
  world.ensure_resource<CameraPoses>();
}

}  // namespace gloam
