// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/systems.h"
#include "modules/accuracy/module.h"
#include "modules/module_list/module_list.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/module.h"
#include "modules/reflections/proxies/systems.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"
#include "sandbox/bench/harness/once.h"
#include "sandbox/bench/reflections/case.h"
#include "sandbox/bench/reflections/halls.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/loading/loaded_scene.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/surface_distances.h"

// Data for reflections that the CPU makes from a scene: fitted proxies, compared with those of the scene's author;
// captures; the proxy tiles of a view.

namespace gloam {
namespace {

struct MeasuredScene {
  const char* name;
  std::optional<double> bake_bar_s;
};
constexpr std::array<MeasuredScene, 2> kReflectionScenes = {{{"courtyard", 10.0}, {"wet_street", std::nullopt}}};
constexpr std::array<std::uint32_t, 2> kProxyCounts = {50, 500};
constexpr int kReflectionSceneRepetitions = 101;
constexpr double kNsPerUs = 1e3;

std::optional<std::string> scene_file_of(const BenchContext& context, const MeasuredScene& scene) {
  if (scene.name == std::string("courtyard")) return courtyard_scene(context);
  return kWetStreet;
}

/// Rays caught by as many fitted proxies as the author placed, over the rays caught by the author's.
Result<BenchValue> caught_ratio(const BenchContext& context, const std::string& file) {
  const auto scene = load_and_pose_scene({.scene = file, .animation = ""}, context.options().threads, context.log());
  if (!scene) return scene.error();
  LoadedScene& s = **scene;
  const auto tracer = make_scene_tracer(s.world, *s.executor);
  if (!tracer) return tracer.error();
  const SurfaceDistances distances = surface_distances(**tracer, s.world.resource<SceneAssets>(), *s.executor);
  std::size_t authored = 0;
  s.world.view<const IbrProxy>().each(
      [&](const IbrProxy& proxy) { authored += proxy.kind == IbrProxyKind::scene ? 1 : 0; });
  const ProxyProposal proposal =
      propose_proxies(s.world, {.count = authored, .cameras = s.info.cameras}, distances, *s.executor);
  std::uint64_t fitted = 0, existing = 0;
  Hasher hasher;
  for (const CaughtShares& shares : proposal.shares) {
    fitted += shares.by_proposed;
    existing += shares.by_existing;
    hasher.value(shares.rays).value(shares.by_proposed).value(shares.by_existing);
  }
  return single_value(static_cast<double>(fitted) / static_cast<double>(std::max<std::uint64_t>(existing, 1)),
                      hasher.digest());
}

Result<BenchValue> bake_seconds(BenchContext& context, const std::string& file) {
  Options options = context.options();
  options.scene = file;
  options.animation.clear();
  options.camera.clear();
  const auto session = open_session(options, context.log());
  if (!session) return session.error();
  const auto begin = std::chrono::steady_clock::now();
  const auto captures = bake_scene(**session, options, context.log());
  if (!captures) return captures.error();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto hash_of = [](const CapturedLayers& layers) { return hash_bytes(std::as_bytes(std::span(layers.texels))); };
  return single_value(seconds, hash_of_both(hash_of(captures->proxies), hash_of(captures->probes)));
}

/// Time of build_proxy_tiles() for a street of proxies in one room, all of them in the camera's.
Result<BenchValue> tiles_us(const BenchContext& context, std::uint32_t proxies) {
  const ModuleList modules = make_all_modules();
  const auto executor = make_pool_executor(context.options().threads);
  World world;
  prepare_world(world, modules);
  SceneInfo info;
  add_proxy_street(world, info, proxies, 1);
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.add_system("ibr_proxies", "reflections", Stage::world, &ibr_proxies_system);
  schedule.run(Stage::world, world, *executor);
  const ProxySet& set = world.resource<ProxySet>();
  ViewSettings settings;
  settings.width = context.options().width;
  settings.height = context.options().height;
  settings.follow_camera = false;
  settings.world_from_camera[3] = dvec4(0.3, 1.7, 4.0, 1.0);
  settings.camera.fov_y = 0.9f;
  const RenderView view = make_view(settings, 0);
  ProxyTiles tiles;
  const auto times = time_ns(kReflectionSceneRepetitions, {},
                             [&] { build_proxy_tiles(set, view, ProxyTileSettings(), *executor, tiles); });
  Hasher hasher;
  for (const std::uint32_t word : tiles.masks) hasher.value(word);
  return per_item(times, kNsPerUs, hasher.digest());
}

using SceneValue = Result<BenchValue> (*)(BenchContext& context, const std::string& file);

/// A row that is skipped if the scene is missing.
BenchRow scene_row(std::string id, const char* unit, std::optional<double> bar, const MeasuredScene& scene,
                   SceneValue value) {
  BenchRow row;
  row.id = std::move(id);
  row.unit = unit;
  row.bar = bar;
  row.run = [scene, value](BenchContext& context) -> Result<BenchValue> {
    const auto file = scene_file_of(context, scene);
    if (!file) return skipped_row(no_courtyard());
    auto result = value(context, *file);
    if (result) result->scene = *file;
    return result;
  };
  return row;
}

}  // namespace

void add_reflection_scene_benches(BenchRegistry& registry) {
  for (const MeasuredScene& scene : kReflectionScenes) {
    BenchRow caught =
        scene_row(std::string("reflections.caught.fitted_over_authored.") + scene.name, "ratio", 0.8, scene,
                  [](BenchContext& context, const std::string& file) { return caught_ratio(context, file); });
    caught.better = Better::higher;
    registry.add(std::move(caught));
  }
  for (const MeasuredScene& scene : kReflectionScenes)
    registry.add(scene_row(std::string("reflections.bake.") + scene.name, "s", scene.bake_bar_s, scene, &bake_seconds));
  for (const std::uint32_t proxies : kProxyCounts) {
    BenchRow row;
    row.id = "reflections.cpu.proxy_tiles." + std::to_string(proxies);
    row.unit = "us";
    row.run = [proxies](BenchContext& context) { return tiles_us(context, proxies); };
    registry.add(std::move(row));
  }
}

}  // namespace gloam
