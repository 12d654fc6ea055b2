// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording/device.h"

namespace gloam::test {

using gpu::Access;

inline gpu::ImageDesc image_desc(std::string name, std::uint32_t side = 64,
                                 gpu::Format format = gpu::Format::rgba8_unorm) {
  return {.name = std::move(name), .module = "test", .format = format, .width = side, .height = side};
}
inline gpu::BufferDesc buffer_desc(std::string name, std::uint64_t size = 256) {
  return {.name = std::move(name), .module = "test", .size = size};
}

/// A frame graph on a recording device. Any reported fault fails the test.
class GraphFixture : public ::testing::Test {
 public:
  /// Declares, compiles and executes one frame.
  void run_frame(const std::function<void(FrameGraph&)>& declare) {
    auto commands = device->begin_frame();
    ASSERT_TRUE(commands.ok());
    graph.begin();
    declare(graph);
    const Status compiled = graph.compile();
    ASSERT_TRUE(compiled.ok()) << compiled.error().message;
    graph.execute(**commands);
    ASSERT_TRUE(device->submit_frame().ok());
  }
  /// The texts of all recorded commands with this name.
  [[nodiscard]] std::vector<std::string> texts(std::string_view name) const {
    std::vector<std::string> found;
    for (const gpu::RecordedCommand& command : device->commands()) {
      if (command.name == name) found.push_back(command.text);
    }
    return found;
  }
  [[nodiscard]] gpu::ImageHandle make_image(gpu::ImageDesc desc, gpu::ImageUsage usage) {
    desc.usage = usage;
    return device->create_image(desc).value();
  }
  [[nodiscard]] gpu::BufferHandle make_buffer(gpu::BufferDesc desc, gpu::BufferUsage usage) {
    desc.usage = usage;
    return device->create_buffer(desc).value();
  }
  [[nodiscard]] std::uint64_t bytes_of_module(std::string_view module) const {
    for (const gpu::ModuleMemory& m : device->memory()) {
      if (m.module == module) return m.bytes;
    }
    return 0;
  }

  void TearDown() override { EXPECT_THAT(device->faults(), ::testing::IsEmpty()); }

  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  FrameGraph graph{*device};
};

}  // namespace gloam::test
