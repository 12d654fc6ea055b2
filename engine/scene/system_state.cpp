// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/system_state.h"

#include "engine/scene/posing/animation.h"

namespace gloam {

void prepare_scene_systems(World& world) {
  world.set_resource(SceneNodes{});
  world.set_resource(AnimationBindings{});
  world.set_resource(TransformTree{});
}

}  // namespace gloam
