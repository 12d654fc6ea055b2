// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/commands.h"
#include "sandbox/session/loading/loaded_scene.h"
#include "sandbox/session/loading/scene_summary.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {

Status run_inspect(const CommandContext& context) {
  const Options& options = context.options;
  KnobRegistry knobs = all_knobs(make_all_modules());
  GLOAM_TRY(set_knobs(knobs, options));
  // Posed: modules warn about things by their places.
  const auto scene = load_and_pose_scene(scene_request(options, knobs), options.threads, context.log);
  if (!scene) return scene.error();
  const auto& [modules, executor, world, info] = **scene;
  const auto camera = find_camera(world, info, options.camera);
  if (!camera) return camera.error();
  const SceneSummary summary = summarize_scene(options.scene, world, info, make_key_registry(modules), modules);
  context.console.print(options.json ? summary_json(summary) : summary_text(summary));
  return {};
}

}  // namespace gloam
