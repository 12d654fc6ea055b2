// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/loader_target.h"

#include <cstdlib>
#include <iostream>
#include <memory>

#include "engine/jobs/executor.h"
#include "engine/scene/assets/check.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
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
  std::string path = folder.path() + "/" + kFileName;
};

Loader& loader() {
  static Loader loader;
  return loader;
}

std::string broken_promise(const Error& error) {
  if (error.kind != ErrorKind::input) return "the error is not an input error: " + error.message;
  if (!error.message.starts_with(kFileName)) return "the error does not name the file: " + error.message;
  if (error.message.find('\n') != std::string::npos) return "the error is not one line: " + error.message;
  return {};
}

}  // namespace

const std::string& scene_path() { return loader().path; }

LoadOutcome load_bytes(std::span<const std::uint8_t> bytes) {
  Loader& shared = loader();
  const std::string path = shared.folder.write(kFileName, bytes);
  World world;
  for (const auto& module : shared.modules) module->register_components(world);
  const auto info = import_gltf(path, {}, shared.registry, world, *shared.executor, null_log());
  if (!info.ok()) return {false, info.error().message, broken_promise(info.error())};
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.run(Stage::world, world, *shared.executor);
  if (const std::string fault = asset_fault(world.resource<SceneAssets>()); !fault.empty())
    return {true, {}, "what was loaded cannot be drawn: " + fault};
  return {true, {}, {}};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gloam::fuzz::LoadOutcome outcome = gloam::fuzz::load_bytes({data, size});
  if (outcome.fault.empty()) return 0;
  std::cerr << outcome.fault << '\n';
  std::abort();
}
