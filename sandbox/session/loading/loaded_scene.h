// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "modules/module_list/module_list.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {

/// A scene in its pose at time 0, without a device.
struct LoadedScene {
  ModuleList modules = make_all_modules();
  std::unique_ptr<JobExecutor> executor;
  World world;
  SceneInfo info;
};

/// Loads a scene and runs the scene systems once. threads: as for make_pool_executor.
[[nodiscard]] Result<std::unique_ptr<LoadedScene>> load_and_pose_scene(const SceneRequest& request,
                                                                       std::uint32_t threads, LogSink& log);

}  // namespace gloam
