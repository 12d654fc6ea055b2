// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/render/kernel_check/kernel_check.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// A KernelRun. Any error fails the test.
class Kernel {
 public:
  static constexpr std::uint32_t kUntouched = KernelRun::kUntouched;

  Kernel(gpu::Device& device, const gpu::ShaderCode& shader, gpu::SpecConstants constants = {})
      : lab_(device, gpu_log()), run_(lab_, shader, std::move(constants)) {
    check();
  }

  template <class T>
  void input(std::uint32_t binding, const std::vector<T>& items) {
    run_.input(binding, items);
    check();
  }
  void output(std::uint32_t binding, std::uint64_t bytes) {
    run_.output(binding, bytes);
    check();
  }
  template <class T>
  void in_out(std::uint32_t binding, const std::vector<T>& items) {
    run_.in_out(binding, items);
    check();
  }
  template <class T>
  void sampled_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                     const std::vector<T>& texels) {
    run_.sampled_image(binding, format, width, height, texels);
    check();
  }
  void sampled_image(std::uint32_t binding, gpu::ImageHandle image, gpu::Filter filter = gpu::Filter::nearest) {
    run_.sampled_image(binding, image, filter);
    check();
  }
  void output_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                    bool as_array = false) {
    run_.output_image(binding, format, width, height, as_array);
    check();
  }
  template <class T>
  void push(const T& constants) {
    run_.push(constants);
  }
  void run(std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) {
    static_cast<void>(run_.run(groups_x, groups_y, groups_z));
    check();
  }
  template <class T>
  [[nodiscard]] std::vector<T> read(std::uint32_t binding) {
    return run_.read<T>(binding);
  }

 private:
  void check() const { ASSERT_TRUE(run_.status().ok()) << run_.status().error().message; }

  KernelLab lab_;
  KernelRun run_;
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
  /// Runs checks as `gloam selftest` does.
  static void expect_holds(const std::vector<KernelCheck>& checks) {
    for (const KernelCheck& check : checks) {
      KernelLab lab(device(), gpu_log());
      const auto found = check.run(lab);
      ASSERT_TRUE(found.ok()) << check.name << ": " << found.error().message;
      EXPECT_LE(found->worst, check.bound) << check.name << ": " << found->where;
    }
  }

 private:
  static std::unique_ptr<gpu::Device>& shared_device() {
    static std::unique_ptr<gpu::Device> device = make_test_device();
    return device;
  }
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test
