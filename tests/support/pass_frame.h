// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/render/kernel_check/pass_run.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// A PassRun. Any error fails the test.
class ReadPassFrames {
 public:
  /// view: of all frames.
  explicit ReadPassFrames(gpu::Device& device, const RenderView& view = {})
      : lab_(device, gpu_log()), run_(lab_, view) {}

  [[nodiscard]] KnobRegistry& knobs() { return run_.knobs(); }
  template <class T>
  [[nodiscard]] gpu::ImageHandle make_image(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                            const std::vector<T>& texels) {
    return run_.make_image(format, width, height, texels);
  }
  void draw(const std::function<void(FrameBuilder&)>& declare) {
    const Status drawn = run_.draw(declare);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  }
  template <class T>
  [[nodiscard]] BufferRef input(const std::string& name, const std::vector<T>& items) {
    return run_.input(name, items);
  }
  [[nodiscard]] ImageRef input(const std::string& name, gpu::ImageHandle image) { return run_.input(name, image); }
  void keep(FrameBuilder& frame, const std::string& name, BufferRef buffer, std::uint64_t bytes) {
    run_.keep(frame, name, buffer, bytes);
  }
  void keep(const std::string& name, ImageRef image) { run_.keep(name, image); }
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) {
    return run_.read<T>(name);
  }

 private:
  KernelLab lab_;
  PassRun run_;
};

}  // namespace gloam::test
