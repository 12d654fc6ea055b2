// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/core/zones.h"
#include "engine/ecs/world.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/pipelines/pipeline_progress.h"
#include "engine/render/renderer.h"
#include "engine/scene/gltf/import.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"

namespace gloam {

/// Device, renderer and loaded scene of a command that draws. Members are created in this order and destroyed in
/// reverse order.
struct Session {
  std::unique_ptr<JobExecutor> executor;
  std::shared_ptr<gpu::Device> device;  ///< shared: sessions may follow one another on one device
  ZoneRecorder zones;
  PipelineProgress pipelines;  ///< of the frame that is being drawn, also of bakes
  std::unique_ptr<Renderer> renderer;
  World world;
  SceneInfo info;
  Entity camera;  ///< kNoEntity: a camera fitted to the scene

  /// Sets the simulated time and the time step of the next frame.
  void set_clock(double time_s, double dt_s);

  /// View settings for the session's camera. Size in pixels. The view follows the camera if it moves.
  [[nodiscard]] ViewSettings view_settings(std::uint32_t width, std::uint32_t height,
                                           const std::string& visualizer) const;

  /// Renders one frame of one view and waits until the GPU has finished it.
  [[nodiscard]] Result<FrameSample> render_frame(const ViewRequest& request);

  /// Returns ErrorKind::failed if the validation layer reported a message.
  [[nodiscard]] Status check_validation() const;
};

/// A window's requirements on the device; members as in gpu::VulkanOptions. Empty: no window.
struct WindowNeeds {
  std::vector<std::string> extensions;
  std::function<std::uint64_t(void* instance)> create_surface;
};

/// Opens the device of --device, --validate and --cache-dir.
[[nodiscard]] Result<std::unique_ptr<gpu::Device>> open_device(const Options& options, LogSink& log,
                                                               const WindowNeeds& window = {});

/// Opens the device, creates the renderer with all modules, sets the knobs (--config, then --set), loads the scene,
/// poses it at --time and checks camera and visualizer. log must outlive the session. more_modules: added after the
/// program's own modules.
[[nodiscard]] Result<std::unique_ptr<Session>> open_session(const Options& options, LogSink& log,
                                                            const WindowNeeds& window = {},
                                                            ModuleList more_modules = {});
/// As open_session, on a device that exists already; --device, --validate and --cache-dir are not read.
[[nodiscard]] Result<std::unique_ptr<Session>> open_session_on(std::shared_ptr<gpu::Device> device,
                                                               const Options& options, LogSink& log,
                                                               ModuleList more_modules = {});

/// The two halves of open_session_on: a session without a scene, and its scene. fill_session draws nothing, so it may
/// run on another thread than the one that draws frames on the device; the session is not used meanwhile.
[[nodiscard]] Result<std::unique_ptr<Session>> open_empty_session(std::shared_ptr<gpu::Device> device,
                                                                  const Options& options, LogSink& log,
                                                                  ModuleList more_modules = {});
[[nodiscard]] Status fill_session(Session& session, const Options& options, LogSink& log);

}  // namespace gloam
