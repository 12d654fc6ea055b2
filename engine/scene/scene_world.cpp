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
  world.ensure_resource<SceneAssets>();
  world.ensure_resource<SceneNames>();
  world.ensure_resource<SceneStrings>();
  world.ensure_resource<SceneEnvironment>();
  world.ensure_resource<SceneClock>();
  world.ensure_resource<JointMatrices>();
  world.ensure_resource<MorphWeights>();
  world.ensure_resource<Teleports>();
  prepare_scene_systems(world);
}

}  // namespace gloam
