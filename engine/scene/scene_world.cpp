// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "engine/scene/system_state.h"

namespace gloam {

void prepare_scene_world(World& world) {
  world.register_component<LocalTransform>("local_transform");
  world.register_component<LocalMatrix>("local_matrix");
  world.register_component<Parent>("parent");
  world.register_component<WorldTransform>("world_transform");
  world.register_component<MeshInstance>("mesh_instance");
  world.register_component<MorphInstance>("morph_instance");
  world.register_component<Camera>("camera");
  world.register_component<SourceNode>("source_node");
  world.set_resource(SceneAssets{});
  world.set_resource(SceneNames{});
  world.set_resource(SceneStrings{});
  world.set_resource(SceneEnvironment{});
  world.set_resource(SceneClock{});
  world.set_resource(JointMatrices{});
  world.set_resource(MorphWeights{});
  world.set_resource(Teleports{});
  prepare_scene_systems(world);
}

}  // namespace gloam
