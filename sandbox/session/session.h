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

/// Device, renderer and a loaded scene: what every command that draws works with. Members are made in their order and
/// end in the opposite one.
struct Session {
  std::unique_ptr<JobExecutor> executor;
  std::unique_ptr<gpu::Device> device;
  ZoneRecorder zones;
  std::unique_ptr<Renderer> renderer;
  World world;
  SceneInfo info;
  Entity camera;  ///< kNoEntity: one fitted to the scene

  /// Simulated time of the frame that is rendered next.
  void set_clock(double time_s, double dt_s);

  /// Of the chosen camera at a size, with a visualizer. A camera that moves is followed.
  [[nodiscard]] ViewSettings view_settings(std::uint32_t width, std::uint32_t height,
                                           const std::string& visualizer) const;

  /// Renders one frame of one view and waits for it.
  [[nodiscard]] Result<FrameSample> render_frame(const ViewRequest& request);

  /// Error of ErrorKind::failed when the validation layer had something to say.
  [[nodiscard]] Status check_validation() const;
};

/// Opens the device, makes the renderer with all modules, sets the knobs (--config, then --set), loads the scene, poses
/// it at
/// --time and checks camera and visualizer. log must outlive the session. window_extensions: of the window system, or
/// empty. more_modules: behind the program's own.
[[nodiscard]] Result<std::unique_ptr<Session>> open_session(const Options& options, LogSink& log,
                                                            const std::vector<std::string>& window_extensions = {},
                                                            ModuleList more_modules = {});

}  // namespace gloam
