// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/module.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

/// What --scene and SCENE name.
struct SceneRequest {
  std::string scene;      ///< path or "builtin:NAME"
  std::string animation;  ///< empty: the first of clips that move the same target
};

/// Cheap checks that need no world: a built-in scene of that name (usage error), a file that can be opened (input
/// error).
[[nodiscard]] Status check_scene_exists(const std::string& scene);

/// "lanterns" of "builtin:lanterns", "courtyard" of "scenes/courtyard.gltf": for names of files.
[[nodiscard]] std::string scene_stem(const std::string& scene);

/// Components and resources of engine and modules, for a world without a renderer.
void prepare_world(World& world, const ModuleList& modules);

/// Fills a prepared world. An animation that the scene does not have is a usage error.
[[nodiscard]] Result<SceneInfo> load_scene(const SceneRequest& request, const ModuleList& modules, World& world,
                                           JobExecutor& executor, LogSink& log);

/// The camera of that name, the scene's first when the name is empty, or kNoEntity when it has none.
[[nodiscard]] Result<Entity> find_camera(const World& world, const SceneInfo& info, const std::string& name);

}  // namespace gloam
