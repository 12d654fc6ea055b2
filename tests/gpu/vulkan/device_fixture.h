// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/gpu/image_size.h"
#include "tests/support/gpu_device.h"

namespace gloam::gpu {

/// Creates a device with validation for each test. Any validation message fails the test.
class VulkanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    device_ = test::make_test_device();
    GLOAM_REQUIRE_GPU(device_);
  }
  void TearDown() override {
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), 0u);
    }
  }
  [[nodiscard]] Device& device() { return *device_; }

  [[nodiscard]] std::uint64_t bytes_of(std::string_view module) {
    for (const ModuleMemory& m : device_->memory()) {
      if (m.module == module) return m.bytes;
    }
    return 0;
  }

  /// Copies one mip of one layer to a new readback buffer. Leaves the image ready for transfer_read.
  [[nodiscard]] BufferHandle read_layer(CommandList& commands, ImageHandle image, Access before,
                                        std::uint32_t layer = 0, std::uint32_t mip = 0) {
    const ImageDesc& desc = device_->desc(image);
    const BufferHandle target = test::make_readback(*device_, mip_bytes(desc, mip));
    const ImageBarrier to_read = {.image = image, .before = before, .after = Access::transfer_read};
    commands.barrier({}, {&to_read, 1});
    commands.copy_image_to_buffer(image, mip, layer, target, 0);
    const BufferBarrier to_host = {.buffer = target, .before = Access::transfer_write, .after = Access::host_read};
    commands.barrier({&to_host, 1}, {});
    return target;
  }

  static void to(CommandList& commands, ImageHandle image, Access before, Access after) {
    const ImageBarrier barrier = {.image = image, .before = before, .after = after};
    commands.barrier({}, {&barrier, 1});
  }
  static void to(CommandList& commands, BufferHandle buffer, Access before, Access after) {
    const BufferBarrier barrier = {.buffer = buffer, .before = before, .after = after};
    commands.barrier({&barrier, 1}, {});
  }

  std::unique_ptr<Device> device_;
};

}  // namespace gloam::gpu
