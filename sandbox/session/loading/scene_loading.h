// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/module.h"
#include "engine/scene/gltf/import.h"
#include "sandbox/options.h"

namespace gloam {

/// The scene and the animation that the command line names.
struct SceneRequest {
  std::string scene;          ///< path or "builtin:NAME"
  std::string animation;      ///< clip to play where several move the same target; empty: the first
  bool default_light = true;  ///< add_default_light(), with a warning
  std::string lights = {};    ///< file of changes to lights (LightPatch); empty: none
};

/// The request of a command line with these knobs (add_program_knobs()).
[[nodiscard]] SceneRequest scene_request(const Options& options, const KnobRegistry& knobs);

/// Cheap check that needs no world. An unknown built-in scene is ErrorKind::usage; a file that cannot be opened is
/// ErrorKind::input.
[[nodiscard]] Status check_scene_exists(const std::string& scene);

/// Whether the name is of a built-in scene, "builtin:NAME".
[[nodiscard]] bool is_builtin(std::string_view scene);

/// The scene's name in names of output files: "lanterns" for "builtin:lanterns", "courtyard" for
/// "scenes/courtyard.gltf".
[[nodiscard]] std::string scene_stem(const std::string& scene);

/// Adds the components and resources of engine and modules, for a world without a renderer.
void prepare_world(World& world, const ModuleList& modules);

/// Loads a scene into a prepared world. An animation that the scene does not have is ErrorKind::usage.
[[nodiscard]] Result<SceneInfo> load_scene(const SceneRequest& request, const ModuleList& modules, World& world,
                                           JobExecutor& executor, LogSink& log);

/// The camera of that name. If the name is empty: the scene's first camera, or kNoEntity if the scene has none.
[[nodiscard]] Result<Entity> find_camera(const World& world, const SceneInfo& info, const std::string& name);

}  // namespace gloam
