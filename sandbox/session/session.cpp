// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/core/system/process.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"
#include "modules/module_list/module_list.h"
#include "sandbox/session/drawing/frame_run.h"
#include "sandbox/session/loading/kept_pipelines.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

Status open_renderer(Session& session, const Options& options, LogSink& log, ModuleList more_modules) {
  ModuleList modules = make_all_modules();
  std::move(more_modules.begin(), more_modules.end(), std::back_inserter(modules));
  auto renderer = Renderer::create({.device = session.device.get(),
                                    .executor = session.executor.get(),
                                    .log = &log,
                                    .zones = &session.zones,
                                    .progress = &session.pipelines,
                                    .modules = std::move(modules)});
  if (!renderer) return renderer.error();
  session.renderer = std::move(renderer).value();
  add_program_knobs(session.renderer->knobs());
  return set_knobs(session.renderer->knobs(), options);
}

/// Poses the scene once before the first frame: a fitted camera needs the posed meshes, and a flight starts at a posed
/// camera.
void pose_scene(Session& session) {
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.run(Stage::world, session.world, *session.executor);
}

}  // namespace

ViewSettings Session::view_settings(std::uint32_t width, std::uint32_t height, const std::string& visualizer) const {
  ViewSettings settings = settings_for_camera(world, camera, width, height);
  settings.heat_range = heat_range(renderer->knobs());
  settings.visualizer = visualizer;
  return settings;
}

void Session::set_clock(double time_s, double dt_s) { world.resource<SceneClock>() = {.time_s = time_s, .dt_s = dt_s}; }

Result<FrameSample> Session::render_frame(const ViewRequest& request) {
  const double begin_ms = processor_time_ms();
  FrameRun run(*this, 1);
  GLOAM_TRY(run.draw(request));
  auto samples = run.finish();
  if (!samples) return samples.error();
  FrameSample sample = std::move(samples->front());
  if (device->info().type == gpu::DeviceType::cpu)
    sample.processor_ms = (processor_time_ms() - begin_ms) / usable_cores();
  return sample;
}

Status Session::check_validation() const {
  const std::uint64_t count = device->validation_messages();
  if (count == 0) return {};
  return Error{ErrorKind::failed,
               "Vulkan validation has " + std::to_string(count) + (count == 1 ? " message" : " messages")};
}

Result<std::unique_ptr<gpu::Device>> open_device(const Options& options, LogSink& log, const WindowNeeds& window) {
  return gpu::create_vulkan_device({.device = options.device,
                                    .validate = options.validate,
                                    .cache_directory = options.cache_dir,
                                    .log = &log,
                                    .window_extensions = window.extensions,
                                    .create_surface = window.create_surface});
}

Result<std::unique_ptr<Session>> open_session(const Options& options, LogSink& log, const WindowNeeds& window,
                                              ModuleList more_modules) {
  GLOAM_TRY(check_scene_exists(options.scene));
  auto device = open_device(options, log, window);
  if (!device) return device.error();
  return open_session_on(std::move(device).value(), options, log, std::move(more_modules));
}

Result<std::unique_ptr<Session>> open_session_on(std::shared_ptr<gpu::Device> device, const Options& options,
                                                 LogSink& log, ModuleList more_modules) {
  GLOAM_TRY(check_scene_exists(options.scene));
  auto session = open_empty_session(std::move(device), options, log, std::move(more_modules));
  if (!session) return session;
  if (options.command == Command::render) make_kept_pipelines(**session, options, log);
  GLOAM_TRY(fill_session(**session, options, log));
  return session;
}

Result<std::unique_ptr<Session>> open_empty_session(std::shared_ptr<gpu::Device> device, const Options& options,
                                                    LogSink& log, ModuleList more_modules) {
  auto session = std::make_unique<Session>();
  session->executor = make_pool_executor(options.threads);
  session->device = std::move(device);
  GLOAM_TRY(open_renderer(*session, options, log, std::move(more_modules)));
  session->renderer->prepare_world(session->world);
  return session;
}

Status fill_session(Session& session, const Options& options, LogSink& log) {
  auto info = load_scene(scene_request(options, session.renderer->knobs()), session.renderer->modules(), session.world,
                         *session.executor, log);
  if (!info) return info.error();
  session.info = std::move(info).value();
  const auto camera = find_camera(session.world, session.info, options.camera);
  if (!camera) return camera.error();
  session.camera = *camera;
  session.set_clock(options.time_s, options.dt_s);
  pose_scene(session);
  if (session.camera != kNoEntity) {
    const ViewSettings followed{.camera_entity = session.camera};
    if (const Status posed = check_camera_pose(session.world, followed); !posed.ok())
      return Error{posed.error().kind, session.info.path + ": " + posed.error().message};
  }
  return session.renderer->check_visualizer(session.world, options.view);
}

}  // namespace gloam
