// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame/transfers/upload.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// One compute pipeline with its resources of set 0: add inputs and outputs, run it, read the outputs. Outputs are
/// filled with words of kUntouched, so that a test sees which words the kernel did not write. Any error fails the test.
class Kernel {
 public:
  static constexpr std::uint32_t kUntouched = 0xA5A5A5A5u;

  Kernel(gpu::Device& device, const gpu::ShaderCode& shader, gpu::SpecConstants constants = {})
      : device_(device),
        pipeline_(value_of(device.create_pipeline(
            gpu::ComputePipelineDesc{std::string(shader.name), "test", shader, std::move(constants)}))) {}
  ~Kernel() {
    static_cast<void>(device_.wait_idle());
    for (const gpu::BufferHandle buffer : buffers_) device_.destroy(buffer);
    for (const gpu::ImageHandle image : images_) device_.destroy(image);
    device_.destroy(pipeline_);
  }
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  /// A storage or uniform buffer with these items (at least one).
  template <class T>
  void input(std::uint32_t binding, const std::vector<T>& items) {
    buffers_.push_back(make_upload(device_, items));
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffers_.back()}});
  }
  /// A storage buffer to be read back.
  void output(std::uint32_t binding, std::uint64_t bytes) {
    const gpu::BufferHandle buffer = make_readback(device_, bytes);
    buffers_.push_back(buffer);
    fill(buffer);
    bindings_.push_back({binding, gpu::Binding::BufferRange{buffer}});
    results_[binding] = buffer;
  }
  /// A storage buffer with these items that the kernel changes, to be read back.
  template <class T>
  void in_out(std::uint32_t binding, const std::vector<T>& items) {
    output(binding, items.size() * sizeof(T));
    std::memcpy(device_.mapped(results_.at(binding)).data(), items.data(), items.size() * sizeof(T));
  }
  /// An image without mips whose texels the kernel fetches.
  template <class T>
  void sampled_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                     const std::vector<T>& texels) {
    const gpu::ImageHandle image =
        make_image(format, width, height, gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target);
    Uploader uploader(device_);
    const auto bytes = std::as_bytes(std::span(texels));
    uploader.image(image, {bytes.begin(), bytes.end()}, gpu::Access::compute_read);
    const Status uploaded = uploader.flush();
    EXPECT_TRUE(uploaded.ok()) << (uploaded.ok() ? "" : uploaded.error().message);
    sampled_image(binding, image);
  }
  /// An image that the caller owns, ready for compute_read.
  void sampled_image(std::uint32_t binding, gpu::ImageHandle image, gpu::Filter filter = gpu::Filter::nearest) {
    gpu::SamplerDesc sampler;
    sampler.address_u = sampler.address_v = gpu::AddressMode::clamp_to_edge;
    sampler.min_filter = sampler.mag_filter = sampler.mip_filter = filter;
    bindings_.push_back({binding, gpu::Binding::Sampled{{.image = image}, value_of(device_.create_sampler(sampler))}});
  }
  /// A storage image to be read back, row by row.
  void output_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                    bool as_array = false) {
    using enum gpu::ImageUsage;
    const gpu::ImageHandle image = make_image(format, width, height, storage | transfer_source | transfer_target);
    const gpu::BufferHandle buffer =
        make_readback(device_, std::uint64_t{width} * height * gpu::bytes_per_texel(format));
    buffers_.push_back(buffer);
    bindings_.push_back({binding, gpu::Binding::Storage{{.image = image, .as_array = as_array}}});
    results_[binding] = buffer;
    image_results_.emplace_back(image, buffer);
  }
  template <class T>
  void push(const T& constants) {
    const auto bytes = std::as_bytes(std::span(&constants, 1));
    constants_.assign(bytes.begin(), bytes.end());
  }

  /// Runs the pipeline once and waits.
  void run(std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) {
    using enum gpu::Access;
    run_frame(device_, [&](gpu::CommandList& commands) {
      for (const auto& [image, buffer] : image_results_) {
        turn(commands, image, none, transfer_write);
        commands.clear_color_image(image, {kUntouched, kUntouched, kUntouched, kUntouched});
        turn(commands, image, transfer_write, compute_write);
      }
      commands.bind_pipeline(pipeline_);
      commands.bind(bindings_);
      if (!constants_.empty()) commands.push_constants(constants_);
      commands.dispatch(groups_x, groups_y, groups_z);
      for (const auto& [image, buffer] : image_results_) {
        turn(commands, image, compute_write, transfer_read);
        commands.copy_image_to_buffer(image, 0, 0, buffer, 0);
      }
      for (const auto& [binding, buffer] : results_) {
        const gpu::BufferBarrier ready = {
            .buffer = buffer, .before = compute_write, .after = host_read, .also_before = gpu::mask_of(transfer_write)};
        commands.barrier({&ready, 1}, {});
      }
    });
  }
  /// The contents of an output after run().
  template <class T>
  [[nodiscard]] std::vector<T> read(std::uint32_t binding) {
    return items_of<T>(device_, results_.at(binding));
  }

 private:
  gpu::ImageHandle make_image(gpu::Format format, std::uint32_t width, std::uint32_t height, gpu::ImageUsage usage) {
    gpu::ImageDesc desc{.name = "test image", .module = "test", .format = format, .width = width, .height = height};
    desc.usage = usage;
    images_.push_back(value_of(device_.create_image(desc)));
    return images_.back();
  }
  void fill(gpu::BufferHandle buffer) {
    const std::span<std::byte> bytes = device_.mapped(buffer);
    std::memset(bytes.data(), static_cast<int>(kUntouched & 0xFFu), bytes.size());
  }
  static void turn(gpu::CommandList& commands, gpu::ImageHandle image, gpu::Access before, gpu::Access after) {
    const gpu::ImageBarrier barrier = {.image = image, .before = before, .after = after};
    commands.barrier({}, {&barrier, 1});
  }

  gpu::Device& device_;
  gpu::PipelineHandle pipeline_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::ImageHandle> images_;
  std::vector<gpu::Binding> bindings_;
  std::map<std::uint32_t, gpu::BufferHandle> results_;
  std::vector<std::pair<gpu::ImageHandle, gpu::BufferHandle>> image_results_;
  std::vector<std::byte> constants_;
};

/// One validated device for all tests of the program. A validation message fails the test during which it appears.
class KernelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(shared_device());
    messages_ = shared_device()->validation_messages();
  }
  void TearDown() override {
    if (shared_device()) {
      EXPECT_EQ(shared_device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static gpu::Device& device() { return *shared_device(); }

 private:
  static std::unique_ptr<gpu::Device>& shared_device() {
    static std::unique_ptr<gpu::Device> device = make_test_device();
    return device;
  }
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test
