// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/module_list/module_list.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/shadows/case.h"
#include "sandbox/scenes/builtin.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

// Size of the pictures that are compared with rays for every light and pixel.
constexpr std::uint32_t kShadowErrorWidth = 320;
constexpr std::uint32_t kShadowErrorHeight = 180;

/// The simpler filters, none of which may be better than the default.
constexpr std::array<const char*, 3> kOthers = {"hard", "pcf", "pcss"};

/// Sessions by scene; only the last one is kept.
struct SharedErrors {
  std::string scene;
  std::unique_ptr<Session> session;
  std::map<std::string, JudgedShadows> judged;  ///< by "scene camera"
};

Result<Session*> shadow_session_of(BenchContext& context, SharedErrors& shared, const std::string& scene,
                                   const std::string& camera) {
  if (shared.session == nullptr || shared.scene != scene) {
    shared.session.reset();
    auto opened = context.open_builtin("builtin:" + scene);
    if (!opened) return opened.error();
    shared.session = std::move(opened).value();
    shared.scene = scene;
  }
  const auto found = shared.session->world.resource<SceneNames>().find("camera", camera);
  if (!found) return found.error();
  shared.session->camera = *found;
  return shared.session.get();
}

Result<const JudgedShadows*> judge_shadows(BenchContext& context, SharedErrors& shared, const std::string& scene,
                                           const std::string& camera) {
  const std::string key = scene + " " + camera;
  if (const auto found = shared.judged.find(key); found != shared.judged.end()) return &found->second;
  auto session = shadow_session_of(context, shared, scene, camera);
  if (!session) return session.error();
  ShadowCase shadows(**session, kShadowErrorWidth, kShadowErrorHeight);
  auto error = shadows.error();
  if (!error) return error.error();
  return &shared.judged.emplace(key, *error).first->second;
}

/// Mean error of the default over that of the best other filter.
Result<BenchValue> over_others(BenchContext& context, SharedErrors& shared, const std::string& scene,
                               const std::string& camera) {
  const auto standard = judge_shadows(context, shared, scene, camera);
  if (!standard) return standard.error();
  auto session = shadow_session_of(context, shared, scene, camera);
  if (!session) return session.error();
  ShadowCase shadows(**session, kShadowErrorWidth, kShadowErrorHeight);
  double least = 1.0;
  for (const char* filter : kOthers) {
    GLOAM_TRY(shadows.set("shadows.filter", filter));
    const auto error = shadows.error();
    if (!error) return error.error();
    least = std::min(least, error->mean());
  }
  constexpr double kNoise = 1e-4;  // of both means; below it the ratio says nothing
  return single_value(((*standard)->mean() + kNoise) / (least + kNoise), (*standard)->hash);
}

void add_shadow_camera_rows(BenchRegistry& registry, const std::shared_ptr<SharedErrors>& shared,
                            const std::string& scene, const std::string& camera) {
  const std::string id = "shadows.error." + scene + "." + camera;
  const auto add = [&](const char* name, const char* unit, std::optional<double> bar, auto value) {
    BenchRow row;
    row.id = id + "." + name;
    row.unit = unit;
    row.bar = bar;
    row.run = [=](BenchContext& context) -> Result<BenchValue> {
      const auto judged = judge_shadows(context, *shared, scene, camera);
      if (!judged) return judged.error();
      BenchValue result = single_value(value(**judged), (*judged)->hash);
      result.scene = "builtin:" + scene;
      return result;
    };
    registry.add(std::move(row));
  };
  add("mean", "visibility", 0.02, [](const JudgedShadows& e) { return e.mean(); });
  add("penumbra", "visibility", 0.08, [](const JudgedShadows& e) { return e.penumbra_mean(); });
  add("off", "share of pairs", std::nullopt, [](const JudgedShadows& e) { return e.off_share(); });
  add("acne", "share of pairs", std::nullopt, [](const JudgedShadows& e) { return e.acne_share(); });
  add("leaks", "share of pairs", std::nullopt, [](const JudgedShadows& e) { return e.leak_share(); });
  add("faint_leaks", "share of pairs", std::nullopt, [](const JudgedShadows& e) { return e.faint_leak_share(); });
  BenchRow row;
  row.id = id + ".over_other_filters";
  row.unit = "ratio";
  row.bar = 1.1;
  row.run = [=](BenchContext& context) -> Result<BenchValue> {
    auto value = over_others(context, *shared, scene, camera);
    if (value) value->scene = "builtin:" + scene;
    return value;
  };
  registry.add(std::move(row));
}

/// The names of a built-in scene's cameras; none if no light of the scene casts shadows.
std::vector<std::string> judged_cameras(const BuiltinScene& scene) {
  const ModuleList modules = make_all_modules();
  World world;
  prepare_world(world, modules);
  SceneInfo info;
  scene.build(world, info);
  std::vector<std::string> cameras;
  for (const auto& module : modules)
    if (module->name() == "shadows" && !module->demand(world, nullptr).needed) return cameras;
  for (const Entity camera : info.cameras) cameras.emplace_back(world.resource<SceneNames>().name_of(camera));
  return cameras;
}

}  // namespace

void add_shadow_error_benches(BenchRegistry& registry) {
  const auto shared = std::make_shared<SharedErrors>();
  for (const BuiltinScene& scene : builtin_scenes())
    for (const std::string& camera : judged_cameras(scene))
      add_shadow_camera_rows(registry, shared, std::string(scene.name), camera);
}

}  // namespace gloam
