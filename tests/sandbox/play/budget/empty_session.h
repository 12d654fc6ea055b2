// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "modules/module_list/module_list.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/session/session.h"

namespace gloam::test {

/// A session without a scene on the recording device, with all knobs. device: gets the device.
inline std::unique_ptr<Session> empty_session(gpu::RecordingDevice*& device) {
  auto session = std::make_unique<Session>();
  auto made = gpu::make_recording_device();
  device = made.get();
  session->executor = make_shuffled_executor(1);
  session->device = std::move(made);
  RendererOptions options;
  options.device = device;
  options.executor = session->executor.get();
  options.modules = make_all_modules();
  session->renderer = Renderer::create(std::move(options)).value();
  add_program_knobs(session->renderer->knobs());
  session->renderer->prepare_world(session->world);
  return session;
}

/// 10, 20 and 40 ms.
inline std::vector<FrontPoint> session_points() {
  return {{.ms = 10.0, .error = 0.1, .settings = {{"shadows.filter", "hard"}, {"views.scale", "0.5"}}},
          {.ms = 20.0, .error = 0.02, .settings = {{"shadows.filter", "pcf"}}},
          {.ms = 40.0, .error = 0.0, .settings = {}}};
}

}  // namespace gloam::test
