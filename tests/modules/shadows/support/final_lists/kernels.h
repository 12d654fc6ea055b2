// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "engine/frame/transfers/upload.h"
#include "engine/math/types.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// Initial value of words that no kernel may write.
inline constexpr std::uint32_t kGuard = 0xA5A5A5A5u;

/// One dispatch with given contents of buffers and images, which are read back after it. Any error fails the test.
class ListDispatch {
 public:
  explicit ListDispatch(gpu::Device& device) : device_(device), uploader_(device) {
    sampler_ = value_of(device.create_sampler(
        {.min_filter = gpu::Filter::nearest, .mag_filter = gpu::Filter::nearest, .mip_filter = gpu::Filter::nearest}));
  }
  ~ListDispatch() {
    static_cast<void>(device_.wait_idle());
    for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
    for (const gpu::ImageHandle image : images_) device_.destroy(image);
  }
  ListDispatch(const ListDispatch&) = delete;
  ListDispatch& operator=(const ListDispatch&) = delete;

  template <class T>
  void input(std::uint32_t binding, const std::vector<T>& items) {
    buffers_.push_back(make_upload(device_, items));
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffers_.back()}});
  }
  /// items: the buffer's content before the dispatch, and after run() its content after the dispatch.
  template <class T>
  void in_out(std::uint32_t binding, std::vector<T>& items) {
    const std::size_t bytes = items.size() * sizeof(T);
    const gpu::BufferHandle buffer = make_readback(device_, bytes);
    std::memcpy(device_.mapped(buffer).data(), items.data(), bytes);
    buffers_.push_back(buffer);
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffer}});
    results_.emplace_back(buffer, gpu::ImageHandle{});
    finish_.push_back(
        [this, buffer, bytes, &items] { std::memcpy(items.data(), device_.mapped(buffer).data(), bytes); });
  }
  template <class T>
  void sampled(std::uint32_t binding, gpu::Format format, uvec2 size, const std::vector<T>& texels,
               gpu::ImageShape shape = gpu::ImageShape::plain) {
    const gpu::ImageHandle made = image(format, size, texels, gpu::Access::compute_read, shape);
    bindings_.push_back({binding, gpu::Binding::Sampled{{.image = made}, sampler_}});
  }
  /// Binds an image that the caller owns, in state compute_read.
  void sampled(std::uint32_t binding, gpu::ImageHandle made) {
    bindings_.push_back({binding, gpu::Binding::Sampled{{.image = made}, sampler_}});
  }
  template <class T>
  void storage_image(std::uint32_t binding, gpu::Format format, uvec2 size, std::vector<T>& texels) {
    const gpu::ImageHandle made = image(format, size, texels, gpu::Access::compute_write, gpu::ImageShape::plain);
    const std::size_t bytes = texels.size() * sizeof(T);
    const gpu::BufferHandle buffer = make_readback(device_, bytes);
    buffers_.push_back(buffer);
    bindings_.push_back({binding, gpu::Binding::Storage{{.image = made}}});
    results_.emplace_back(buffer, made);
    finish_.push_back(
        [this, buffer, bytes, &texels] { std::memcpy(texels.data(), device_.mapped(buffer).data(), bytes); });
  }
  /// Sets the push constants of the next calls of run().
  template <class T>
  void push(const T& constants) {
    const auto bytes = std::as_bytes(std::span(&constants, 1));
    constants_.assign(bytes.begin(), bytes.end());
  }
  void run(gpu::PipelineHandle pipeline, uvec2 groups) {
    using enum gpu::Access;
    const Status uploaded = uploader_.flush();
    ASSERT_TRUE(uploaded.ok()) << uploaded.error().message;
    run_frame(device_, [&](gpu::CommandList& commands) {
      commands.bind_pipeline(pipeline);
      commands.bind(bindings_);
      if (!constants_.empty()) commands.push_constants(constants_);
      commands.dispatch(groups.x, groups.y, 1);
      for (const auto& [buffer, made] : results_) {
        if (made) {
          const gpu::ImageBarrier written{.image = made, .before = compute_write, .after = transfer_read};
          commands.barrier({}, {&written, 1});
          commands.copy_image_to_buffer(made, 0, 0, buffer, 0);
        }
        const gpu::BufferBarrier done{
            .buffer = buffer, .before = compute_write, .after = host_read, .also_before = gpu::mask_of(transfer_write)};
        commands.barrier({&done, 1}, {});
      }
    });
    for (const auto& finish : finish_) finish();
  }

 private:
  template <class T>
  gpu::ImageHandle image(gpu::Format format, uvec2 size, const std::vector<T>& texels, gpu::Access access,
                         gpu::ImageShape shape) {
    using enum gpu::ImageUsage;
    gpu::ImageDesc desc{.name = "test image", .module = "test", .format = format, .width = size.x, .height = size.y};
    desc.usage =
        transfer_target | (access == gpu::Access::compute_read ? gpu::ImageUsage::sampled : storage | transfer_source);
    desc.shape = shape;
    images_.push_back(value_of(device_.create_image(desc)));
    const auto bytes = std::as_bytes(std::span(texels));
    uploader_.image(images_.back(), {bytes.begin(), bytes.end()}, access);
    return images_.back();
  }

  gpu::Device& device_;
  Uploader uploader_;
  gpu::SamplerHandle sampler_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::ImageHandle> images_;
  std::vector<gpu::Binding> bindings_;
  std::vector<std::pair<gpu::BufferHandle, gpu::ImageHandle>> results_;
  std::vector<std::function<void()>> finish_;
  std::vector<std::byte> constants_;
};

}  // namespace gloam::test
