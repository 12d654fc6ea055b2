// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "modules/depth_of_field/reference/blur_run.h"
#include "tests/support/gpu_device.h"
#include "tests/support/pass_frame.h"

namespace gloam::test {

/// The result of the module's passes. Any error fails the test.
[[nodiscard]] inline DofResult run_dof(gpu::Device& device, const DofInput& in) {
  return value_of(gloam::run_dof(KernelLab(device, gpu_log()), in));
}

/// Runs on a validated device, with the shaders for threads in turn (true) and for threads together (false).
class DofChainTest : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device());
    messages_ = device()->validation_messages();
  }
  void TearDown() override {
    if (device()) {
      EXPECT_EQ(device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static DofResult run(const DofInput& in) { return run_dof(*device(), in); }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> devices[] = {make(false), make(true)};
    return devices[GetParam() ? 1 : 0].get();
  }

 private:
  static std::unique_ptr<gpu::Device> make(bool in_turn) {
    gpu::VulkanOptions options = test_device_options();
    options.threads_in_turn = in_turn;
    return make_test_device(true, options);
  }
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test
