// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/renderer.h"
#include "modules/module_list/module_list.h"
#include "tests/render/draws/small_scene.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {

/// A renderer on a recording device with a world that holds one of everything that can be drawn and two lights. Keeps
/// the lines of the log.
struct CarelessHost {
  explicit CarelessHost(ModuleList modules = make_all_modules()) {
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.log = &log;
    options.modules = std::move(modules);
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    fill_small_scene(world);
    if (renderer->modules().size() > 0 && renderer->modules().front()->name() == "lights") add_lights(world);
  }

  [[nodiscard]] static ViewRequest request(std::uint32_t id = 0, std::uint32_t width = 64, std::uint32_t height = 40) {
    ViewRequest request;
    request.settings = look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), width, height);
    request.settings.id = ViewId{id};
    return request;
  }
  [[nodiscard]] Status render(const ViewRequest& view) { return renderer->render(world, {&view, 1}); }
  /// The error of a frame with this view; empty if it was drawn.
  [[nodiscard]] std::string error_of(const ViewRequest& view) {
    const Status status = render(view);
    return status.ok() ? std::string() : status.error().message;
  }
  [[nodiscard]] gpu::ImageHandle image(gpu::ImageUsage usage, gpu::Format format = gpu::Format::rgba8_srgb) {
    return device
        ->create_image({.name = "host", .module = "host", .format = format, .width = 64, .height = 40, .usage = usage})
        .value();
  }

  std::vector<std::string> lines;
  FunctionLog log{[this](LogLevel level, std::string_view line) {
    if (level >= LogLevel::warning) lines.emplace_back(line);
  }};
  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  World world;
  std::unique_ptr<Renderer> renderer;
};

}  // namespace gloam::test
