// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/scene/key_registry.h"

namespace gloam {

struct ImportOptions {
  std::string animation;  ///< clip to prefer where clips move the same target; empty: the first wins
  int scene = -1;         ///< glTF scene index; −1: the file's default, else the first
};

/// What the file held, for `inspect` and tests.
struct SceneInfo {
  std::string path;
  std::string name;
  std::vector<Entity> node_entities;   ///< by glTF node index; kNoEntity for nodes outside the chosen scene
  std::vector<Entity> cameras;         ///< in file order of their nodes
  std::uint64_t triangles = 0;         ///< of all mesh nodes of the scene
  std::uint64_t replaced_normals = 0;  ///< normals without length that got a direction from the faces around them
  std::vector<std::string> warnings;   ///< also sent to the log
};

/// Registers the scene's own components and puts their resources (SceneAssets, SceneNames, SceneStrings,
/// SceneEnvironment, SceneClock, JointMatrices, MorphWeights) in place, empty. For worlds built by code and before an
/// import.
void prepare_scene_world(World& world);

/// Loads a .gltf or .glb into the world: one entity a node, assets into SceneAssets. Images are decoded in jobs. On
/// failure (ErrorKind::input, one sentence: file, place, fault) the world's content is unspecified. Never uses memory
/// beyond what the file justifies.
[[nodiscard]] Result<SceneInfo> import_gltf(const std::string& path, const ImportOptions& options,
                                            const KeyRegistry& registry, World& world, JobExecutor& executor,
                                            LogSink& log);

}  // namespace gloam
