// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/core/zones.h"
#include "engine/ecs/world.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "engine/scene/gltf_import.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"

namespace gloam {

/// Device, renderer and loaded scene of a command that draws. Members are created in this order and destroyed in
/// reverse order.
struct Session {
  std::unique_ptr<JobExecutor> executor;
  std::unique_ptr<gpu::Device> device;
  ZoneRecorder zones;
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

/// Opens the device, creates the renderer with all modules, sets the knobs (--config, then --set), loads the scene,
/// poses it at --time and checks camera and visualizer. log must outlive the session. window_extensions: Vulkan
/// instance extensions of the window system, or empty. more_modules: added after the program's own modules.
[[nodiscard]] Result<std::unique_ptr<Session>> open_session(const Options& options, LogSink& log,
                                                            const std::vector<std::string>& window_extensions = {},
                                                            ModuleList more_modules = {});

}  // namespace gloam
