// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
#include "sandbox/commands/commands.h"
#include "sandbox/session/scene_loading.h"
#include "sandbox/session/scene_summary.h"

namespace gloam {

Status run_inspect(const CommandContext& context) {
  const Options& options = context.options;
  GLOAM_TRY(check_scene_exists(options.scene));
  const ModuleList modules = make_all_modules();
  const auto executor = make_pool_executor(options.threads);
  World world;
  prepare_world(world, modules);
  const auto info =
      load_scene({.scene = options.scene, .animation = options.animation}, modules, world, *executor, context.log);
  if (!info) return info.error();
  const auto camera = find_camera(world, *info, options.camera);
  if (!camera) return camera.error();
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.run(Stage::world, world, *executor);  // modules warn about things by their places
  const SceneSummary summary = summarize_scene(options.scene, world, *info, make_key_registry(modules), modules);
  context.console.print(options.json ? summary_json(summary) : summary_text(summary));
  return {};
}

}  // namespace gloam
