// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/transfers/upload.h"
#include "engine/render/declare/pass_frames.h"
#include "engine/render/readback/capture.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// PassFrames whose inputs are vectors and whose results are read back. Without draws, so they run at every vector
/// width of lavapipe. Any error fails the test.
class ReadPassFrames {
 public:
  /// view: of all frames.
  explicit ReadPassFrames(gpu::Device& device, const RenderView& view = {})
      : device_(device), frames_(device, gpu_log(), "test", view) {}
  ~ReadPassFrames() {
    static_cast<void>(device_.wait_idle());
    for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
    for (const gpu::ImageHandle image : images_) device_.destroy(image);
  }
  ReadPassFrames(const ReadPassFrames&) = delete;
  ReadPassFrames& operator=(const ReadPassFrames&) = delete;

  [[nodiscard]] KnobRegistry& knobs() { return frames_.knobs(); }

  /// Before draw(): an image without mips with these texels, for input(). Passes may sample and write it.
  template <class T>
  [[nodiscard]] gpu::ImageHandle make_image(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                            const std::vector<T>& texels) {
    using enum gpu::ImageUsage;
    gpu::ImageDesc desc{.name = "test image", .module = "test", .format = format, .width = width, .height = height};
    desc.usage = sampled | storage | transfer_target | transfer_source;
    images_.push_back(value_of(device_.create_image(desc)));
    Uploader uploader(device_);
    const auto bytes = std::as_bytes(std::span(texels));
    uploader.image(images_.back(), {bytes.begin(), bytes.end()}, gpu::Access::compute_read);
    const Status uploaded = uploader.flush();
    EXPECT_TRUE(uploaded.ok()) << (uploaded.ok() ? "" : uploaded.error().message);
    return images_.back();
  }
  /// Draws a frame with the passes that declare(FrameBuilder&) adds, and waits for it.
  void draw(const std::function<void(FrameBuilder&)>& declare) {
    run_frame(device_, [&](gpu::CommandList& commands) {
      const Status drawn = frames_.record(commands, declare);
      EXPECT_TRUE(drawn.ok()) << (drawn.ok() ? "" : drawn.error().message);
    });
  }
  /// In declare(): a buffer of the frame with these items (at least one).
  template <class T>
  [[nodiscard]] BufferRef input(const std::string& name, const std::vector<T>& items) {
    buffers_.push_back(make_upload(device_, items));
    return frames_.graph().import_buffer(name, buffers_.back(), gpu::Access::none, gpu::Access::none);
  }
  /// In declare(): an image of make_image().
  [[nodiscard]] ImageRef input(const std::string& name, gpu::ImageHandle image) {
    return frames_.graph().import_image(name, image, gpu::Access::compute_read, gpu::Access::compute_read);
  }
  /// In declare(): keeps the first `bytes` of a buffer for read(). buffer: the version that no later pass writes.
  void keep(FrameBuilder& frame, const std::string& name, BufferRef buffer, std::uint64_t bytes) {
    const gpu::BufferHandle target = make_readback(device_, bytes);
    buffers_.push_back(target);
    kept_[name] = target;
    PassBuilder pass = frames_.graph().add_pass("keep_" + name, frame.module());
    pass.keep();
    pass.read(buffer, gpu::Access::transfer_read);
    const BufferRef copy =
        pass.write(frames_.graph().import_buffer(name + "_copy", target, gpu::Access::none, gpu::Access::host_read),
                   gpu::Access::transfer_write);
    pass.execute([buffer, copy, bytes](PassContext& context) {
      context.commands().copy_buffer(context.buffer(buffer), 0, context.buffer(copy), 0, bytes);
    });
  }
  /// In declare(): keeps the first mip and layer of an image for read(), row by row.
  void keep(const std::string& name, ImageRef image) {
    const gpu::BufferHandle target = value_of(capture_image(frames_.graph(), device_, image)).buffer;
    buffers_.push_back(target);
    kept_[name] = target;
  }
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) {
    return items_of<T>(device_, kept_.at(name));
  }

 private:
  gpu::Device& device_;
  PassFrames frames_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::ImageHandle> images_;
  std::map<std::string, gpu::BufferHandle> kept_;
};

}  // namespace gloam::test
