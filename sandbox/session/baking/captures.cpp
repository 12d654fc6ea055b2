// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/baking/captures.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/accuracy/module.h"
#include "modules/module_list/module_list.h"
#include "modules/reflections/components.h"
#include "sandbox/output/progress_bar.h"
#include "sandbox/session/baking/particle_light.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

bool wants_captures(const Session& session) {
  return std::ranges::any_of(session.renderer->modules(), [&](const auto& module) {
    return module->name() == "reflections" && module->demand(session.world, nullptr).needed;
  });
}

constexpr const char* kIndirectKnob = "lighting.indirect";

IndirectSource chosen_light(const Session& session) {
  const KnobRegistry& knobs = session.renderer->knobs();
  const Knob* source = knobs.find(kIndirectKnob);
  const bool probes = source != nullptr && knobs.text(*source) == name_of(IndirectSource::probes);
  return probes ? IndirectSource::probes : IndirectSource::sky;
}

std::optional<ReflectionCaptures> load_kept(const Session& session, const Options& options, IndirectSource light,
                                            LogSink& log) {
  const std::uint64_t content = capture_content(session.world, light);
  for (const std::string& path : {captures_beside(options.scene), cached_captures(session, options, content)}) {
    if (path.empty()) continue;
    // The one file beside a scene may be of either light.
    LogSink& listener = light == IndirectSource::sky ? log : null_log();
    if (auto captures = load_captures(path, session.world, content, listener)) return captures;
  }
  return std::nullopt;
}

bool has_pictures(const ReflectionCaptures& captures) { return captures.proxies.count + captures.probes.count > 0; }

/// Whether a file of captures may exist, found without a hash of the scene's content.
bool may_have_kept(const Options& options) {
  std::error_code error;
  const std::string beside = captures_beside(options.scene);
  if (!beside.empty() && std::filesystem::exists(beside, error)) return true;
  return !options.cache_dir.empty() && std::filesystem::exists(options.cache_dir + "/captures", error);
}

}  // namespace

std::string captures_beside(const std::string& scene) {
  if (is_builtin(scene)) return {};
  return std::filesystem::path(scene).replace_extension(".captures").string();
}

std::string cached_captures(const Session& session, const Options& options, std::uint64_t content) {
  if (options.cache_dir.empty()) return {};
  // Devices round differently, and a picture must not depend on the device of an earlier run.
  const std::uint64_t key = Hasher().value(content).text(session.device->info().name).digest();
  char name[48];
  std::snprintf(name, sizeof(name), "/captures/%016llx.captures", static_cast<unsigned long long>(key));
  return options.cache_dir + name;
}

Result<ReflectionCaptures> bake_scene(Session& session, const Options& options, LogSink& log,
                                      const BakeProgress& progress, std::vector<GridProbe> grid) {
  auto renderer = Renderer::create({.device = session.device.get(),
                                    .executor = session.executor.get(),
                                    .log = &log,
                                    .progress = &session.pipelines,
                                    .modules = make_all_modules()});
  if (!renderer) return renderer.error();
  GLOAM_TRY((*renderer)->knobs().set(kIndirectKnob, name_of(chosen_light(session))));
  World world;
  (*renderer)->prepare_world(world);
  // The session's own load has logged the warnings.
  const auto info = load_scene(scene_request(options, session.renderer->knobs()), (*renderer)->modules(), world,
                               *session.executor, null_log());
  if (!info) return info.error();
  world.resource<SceneClock>() = {.time_s = 0.0};
  JobExecutor& executor = *session.executor;
  const auto captures = bake_reflections(
      **renderer, world,
      {.executor = &executor,
       .progress = progress,
       .grid_probes = options.grid_probes,
       .grid = std::move(grid),
       .make_tracer = [&executor](const World& traced) { return make_scene_tracer(traced, executor); }});
  const Status idle = (*renderer)->wait();
  (*renderer)->release_world(world);
  if (!captures) return captures.error();
  GLOAM_TRY(idle);
  auto moved = decode_captures(session.world, encode_captures(world, *captures));
  if (!moved) return Error{ErrorKind::failed, options.scene + ": has changed while its reflections were captured"};
  return std::move(*moved);
}

Status ensure_captures(Session& session, const Options& options, LogSink& log, const BakeProgress& progress) {
  const IndirectSource light = chosen_light(session);
  const bool wanted =
      wants_captures(session) || (light == IndirectSource::probes && session.world.view<const CubeProbe>().size() > 0);
  // A scene that demands no captures may have kept ones with diffuse light (bake --probes). They are read whatever
  // lighting.indirect is, because it may change later.
  if (!wanted && !may_have_kept(options)) return {};
  auto kept = load_kept(session, options, light, log);
  std::vector<GridProbe> grid;
  if (!kept && light == IndirectSource::probes) {
    // The grid of captures in the light of the sky serves, too, and so do all of them if they have no pictures.
    kept = load_kept(session, options, IndirectSource::sky, log);
    if (kept && has_pictures(*kept)) {
      grid = std::move(kept->grid);
      kept.reset();
    }
  }
  if (kept) {
    attach_captures(session.world, std::move(*kept));
    return {};
  }
  if (!wanted) return {};
  auto captures = bake_scene(session, options, log, progress, std::move(grid));
  if (!captures) return captures.error();
  if (const std::string path = cached_captures(session, options, captures->content); !path.empty())
    if (const Status saved = save_captures(path, session.world, *captures); !saved.ok())
      log.warning(saved.error().message);
  attach_captures(session.world, std::move(captures).value());
  return {};
}

Status ensure_baked(Session& session, const Options& options, LogSink& log, Console* console) {
  const auto progress = [&](const char* what) {
    return console == nullptr ? BakeProgress() : show_bake_progress(*console, options.quiet, what);
  };
  GLOAM_TRY(ensure_captures(session, options, log, progress("reflection captures")));
  return ensure_particle_light(session, options, log, progress("particle light"));
}

BakeProgress show_bake_progress(Console& console, bool quiet, std::string what) {
  if (quiet) return {};
  using Clock = std::chrono::steady_clock;
  return [&console, begin = Clock::now(), what = std::move(what)](std::size_t done, std::size_t total) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - begin).count();
    console.show_progress(done == total ? "" : progress_line(done, total, what, done, elapsed_s));
  };
}

}  // namespace gloam
