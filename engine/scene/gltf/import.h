// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/scene/keys/registry.h"

namespace gloam {

struct ImportOptions {
  std::string animation;  ///< clip that wins if clips animate the same target; empty: the first clip wins
  int scene = -1;         ///< glTF scene index; −1: the file's default, else the first
};

/// Summary of an imported file, for `inspect` and tests.
struct SceneInfo {
  std::string path;
  std::string name;
  std::vector<Entity> node_entities;   ///< by glTF node, then instances; kNoEntity outside the chosen scene
  std::vector<Entity> cameras;         ///< in order of their glTF node index
  std::uint64_t triangles = 0;         ///< of all mesh nodes of the scene
  std::uint64_t replaced_normals = 0;  ///< normals of zero length, computed from the faces around them
  std::vector<std::string> warnings;   ///< also sent to the log
};

/// Registers the scene's components and adds its resources, all empty (SceneAssets, SceneNames, SceneStrings,
/// SceneEnvironment, SceneClock, JointMatrices, MorphWeights). For worlds that code builds; import_gltf calls it
/// itself.
void prepare_scene_world(World& world);

/// Loads a .gltf or .glb into the world: one entity per node, assets into SceneAssets. Images are decoded in jobs.
/// Fails with ErrorKind::input for a faulty file and ErrorKind::usage for options that name an unknown clip or scene;
/// the message is one sentence: file, place, fault. The world's content is unspecified after a failure. Never uses more
/// memory than the size of the file justifies.
[[nodiscard]] Result<SceneInfo> import_gltf(const std::string& path, const ImportOptions& options,
                                            const KeyRegistry& registry, World& world, JobExecutor& executor,
                                            LogSink& log);

}  // namespace gloam
