// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/loaded_scene.h"

#include <utility>

#include "engine/scene/systems.h"

namespace gloam {

Result<std::unique_ptr<LoadedScene>> load_and_pose_scene(const SceneRequest& request, std::uint32_t threads,
                                                         LogSink& log) {
  GLOAM_TRY(check_scene_exists(request.scene));
  auto scene = std::make_unique<LoadedScene>();
  scene->executor = make_pool_executor(threads);
  prepare_world(scene->world, scene->modules);
  auto info = load_scene(request, scene->modules, scene->world, *scene->executor, log);
  if (!info) return info.error();
  scene->info = std::move(info).value();
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.run(Stage::world, scene->world, *scene->executor);
  return scene;
}

}  // namespace gloam
