// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/frame/renderer_parts.h"

#include <string>
#include <utility>

#include "engine/core/zones.h"
#include "engine/render/views/renderer_knobs.h"
#include "engine/scene/systems.h"

namespace gloam {

RendererParts::RendererParts(RendererOptions given)
    : options(std::move(given)),
      log(*options.log, "render"),
      zones_for_both(options.zones, options.profiler),
      device_user(*options.device),
      resources(*options.device),
      modules(std::move(options.modules)),
      worlds(*options.device, resources.pipelines,
             {.background = options.readiness == Readiness::background, .budget = options.upload_budget}),
      views(*options.device) {
  options.log = &log;
  add_scene_systems(schedule);
  modules.add_to(knobs.set, schedule);
  add_renderer_knobs(knobs.set);
}

RendererParts::~RendererParts() {
  static_cast<void>(options.device->wait_idle());
  modules.release_all();
}

FrameServices RendererParts::services(const KnobRegistry& view_knobs) {
  return {.device = *options.device,
          .executor = *options.executor,
          .log = *options.log,
          .knobs = view_knobs,
          .pipelines = resources.pipelines,
          .uniforms = *resources.uniforms,
          .storage = *resources.storage,
          .results = resources.results,
          .declared = resources.declared,
          .history = resources.history,
          .wait_for_pipelines = options.readiness == Readiness::wait};
}

Profiler* RendererParts::zones() {
  if (options.profiler == nullptr) return options.zones;
  return options.zones == nullptr ? options.profiler : &zones_for_both;
}

PipelineWait RendererParts::pipeline_wait() {
  return {options.readiness, resources.pipelines, options.device->info(), *options.log};
}

void RendererParts::make_pipelines_ahead(const BudgetControl& control) {
  for (const int step : {-1, 1}) {
    KnobRegistry values = knobs.set;
    if (control.set_neighbour(step, values)) static_cast<void>(modules.shown_pipelines_ready(values, pipeline_wait()));
  }
}

void RendererParts::check_idle(std::string_view call) const {
  GLOAM_ASSERT(!drawing, "Renderer::" + std::string(call) + " is called while a frame is being drawn");
}

void release_world(RendererParts& parts, std::uint64_t world) {
  parts.worlds.release(world);
  parts.resources.forget_world(world);
  parts.views.release_world(world);
  parts.modules.release_modules_of([&](std::uint64_t of, std::uint32_t) { return of == world; }, parts.resources);
}

void release_lost_worlds(RendererParts& parts) {
  for (const std::uint64_t world : parts.worlds.lost()) {
    if (parts.worlds.has_scene(world))
      parts.options.log->warning(
          "a world was destroyed without Renderer::release_world: its GPU memory was kept until now");
    release_world(parts, world);
    parts.worlds.remove(world);
  }
}

void release_view(RendererParts& parts, ViewId view) {
  parts.resources.forget_view(view);
  parts.views.release_view(view);
  parts.modules.release_view(view);
  parts.modules.release_modules_of([&](std::uint64_t, std::uint32_t id) { return id == view.value; }, parts.resources);
}

}  // namespace gloam
