// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/scene_target.h"

#include <filesystem>
#include <memory>

#include "engine/jobs/executor.h"
#include "engine/scene/assets/check.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
#include "tests/fuzz/scene_seeds.h"
#include "tests/support/gltf_files.h"

namespace gloam::fuzz {
namespace {

constexpr const char* kFileName = "scene.gltf";

/// Objects that all inputs share.
struct Loader {
  ModuleList modules = make_all_modules();
  KeyRegistry registry = make_key_registry(modules);
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  test::TemporaryFolder folder;
};

Loader& loader() {
  static Loader loader;
  return loader;
}

}  // namespace

Outcome load_scene_bytes(Input bytes) {
  Loader& shared = loader();
  // ext4 waits for the disk when a file is replaced in its place.
  std::filesystem::remove(shared.folder.path() + "/" + kFileName);
  const std::string path = shared.folder.write(kFileName, bytes);
  World world;
  for (const auto& module : shared.modules) module->register_components(world);
  const auto info = import_gltf(path, {}, shared.registry, world, *shared.executor, null_log());
  if (!info.ok()) {
    if (!info.error().message.starts_with(kFileName)) return broken("the error does not begin with the file's name");
    return refused(info.error(), ErrorKind::input);
  }
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.run(Stage::world, world, *shared.executor);
  if (const std::string fault = asset_fault(world.resource<SceneAssets>()); !fault.empty())
    return broken("what was loaded cannot be drawn: " + fault);
  return accepted();
}

Target scene_target() { return {"scene", {{"scene file", load_scene_bytes, scene_seeds}}}; }

}  // namespace gloam::fuzz
