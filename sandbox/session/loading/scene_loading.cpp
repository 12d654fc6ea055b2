// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/scene_loading.h"

#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/core/text/nearest_name.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/glare/components.h"
#include "modules/reflections/bake.h"
#include "sandbox/output/file_io.h"
#include "sandbox/scenes/builtin.h"
#include "sandbox/session/loading/default_light.h"
#include "sandbox/session/loading/light_patch.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

constexpr std::string_view kBuiltinPrefix = "builtin:";

/// "; did you mean builtin:NAME?" if `scene` is close to a built-in scene's name whose prefix is missing or misspelt;
/// otherwise empty.
std::string meant_builtin(std::string_view scene) {
  std::vector<std::string> names;
  for (const BuiltinScene& builtin : builtin_scenes()) names.emplace_back(builtin.name);
  const std::string_view nearest = nearest_name(scene.substr(scene.rfind(':') + 1), names);
  return nearest.empty() ? "" : "; did you mean " + std::string(kBuiltinPrefix) + std::string(nearest) + "?";
}

Status check_animation(const World& world, const std::string& name) {
  if (name.empty()) return {};
  std::vector<std::string> names;
  for (const AnimationClip& clip : world.resource<SceneAssets>().clips) {
    if (clip.name == name) return {};
    names.push_back(clip.name);
  }
  return Error{ErrorKind::usage, "there is no animation '" + name + "'; " + valid_names(name, names)};
}

}  // namespace

bool is_builtin(std::string_view scene) { return scene.starts_with(kBuiltinPrefix); }

Status check_scene_exists(const std::string& scene) {
  if (is_builtin(scene)) {
    const auto found = find_builtin_scene(std::string_view(scene).substr(kBuiltinPrefix.size()));
    return found.ok() ? Status() : Status(found.error());
  }
  std::error_code fault;
  if (std::filesystem::is_regular_file(scene, fault)) return {};
  if (std::filesystem::exists(scene, fault)) return Error{ErrorKind::input, scene + ": is not a file"};
  return Error{ErrorKind::input, scene + ": there is no such file" + meant_builtin(scene)};
}

std::string scene_stem(const std::string& scene) {
  if (is_builtin(scene)) return scene.substr(kBuiltinPrefix.size());
  return std::filesystem::path(scene).stem().string();
}

SceneRequest scene_request(const Options& options, const KnobRegistry& knobs) {
  return {.scene = options.scene,
          .animation = options.animation,
          .default_light = knobs.value(kDefaultLight),
          .lights = options.lights};
}

void prepare_world(World& world, const ModuleList& modules) {
  prepare_scene_world(world);
  for (const auto& module : modules) module->register_components(world);
}

Result<SceneInfo> load_scene(const SceneRequest& request, const ModuleList& modules, World& world,
                             JobExecutor& executor, LogSink& log) {
  SceneInfo info;
  if (is_builtin(request.scene)) {
    const auto scene = find_builtin_scene(std::string_view(request.scene).substr(kBuiltinPrefix.size()));
    if (!scene) return scene.error();
    info.path = request.scene;
    scene.value()->build(world, info);
    add_flame_proxies(world);
    add_default_glare(world);
  } else {
    const KeyRegistry registry = make_key_registry(modules);
    auto imported = import_gltf(request.scene, {.animation = request.animation}, registry, world, executor, log);
    if (!imported) return imported;
    info = std::move(imported).value();
  }
  GLOAM_TRY(check_animation(world, request.animation));
  if (request.default_light && add_default_light(world, info)) log.warning(kDefaultLightSentence);
  if (!request.lights.empty()) {
    const auto text = read_text_file(request.lights, ErrorKind::usage);
    if (!text) return text.error();
    const auto patch = parse_light_patch(*text, request.lights);
    if (!patch) return patch.error();
    GLOAM_TRY(apply_light_patch(world, *patch));
  }
  return info;
}

Result<Entity> find_camera(const World& world, const SceneInfo& info, const std::string& name) {
  if (!name.empty()) return world.resource<SceneNames>().find("camera", name);
  return info.cameras.empty() ? kNoEntity : info.cameras.front();
}

}  // namespace gloam
