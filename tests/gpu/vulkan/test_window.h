// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>
// GLFW declares its functions for Vulkan after Vulkan's own types.
#include <GLFW/glfw3.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "tests/support/gpu_device.h"

namespace gloam::gpu {

/// A window of 200×100 pixels on the display of the environment.
class TestWindow {
 public:
  TestWindow() : has_display_(glfwInit() == GLFW_TRUE) {
    has_vulkan_ = has_display_ && glfwVulkanSupported() == GLFW_TRUE;
    if (!has_vulkan_) return;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(200, 100, "test", nullptr, nullptr);
  }
  ~TestWindow() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }
  TestWindow(const TestWindow&) = delete;
  TestWindow& operator=(const TestWindow&) = delete;

  [[nodiscard]] bool has_display() const { return has_display_; }
  [[nodiscard]] bool has_vulkan() const { return has_vulkan_; }
  /// Null without a display, or without Vulkan.
  [[nodiscard]] GLFWwindow* get() const { return window_; }
  /// For VulkanOptions and create_swapchain.
  [[nodiscard]] std::uint64_t make_surface(void* instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    glfwCreateWindowSurface(static_cast<VkInstance>(instance), window_, nullptr, &surface);
    return (std::uint64_t)surface;
  }
  /// Of a device that presents to the window.
  [[nodiscard]] VulkanOptions options() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {.validate = true,
            .log = &test::gpu_log(),
            .window_extensions = {names, names + count},
            .create_surface = [this](void* instance) { return make_surface(instance); }};
  }

 private:
  bool has_display_ = false, has_vulkan_ = false;
  GLFWwindow* window_ = nullptr;
};

/// Tests with a window and its device. They are skipped only on a machine without a usable device: another error, or a
/// display that is missing, fails them.
class WindowFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(window_.has_display()) << "there is no display: run under Xvfb";
    if (!window_.has_vulkan()) GTEST_SKIP() << "there is no usable Vulkan device on this machine";
    ASSERT_NE(window_.get(), nullptr);
    auto made = create_vulkan_device(window_.options());
    if (!made && made.error().kind == ErrorKind::no_device) GTEST_SKIP() << made.error().message;
    ASSERT_TRUE(made.ok()) << made.error().message;
    device_ = std::move(*made);
  }

  TestWindow window_;
  std::unique_ptr<Device> device_;
};

}  // namespace gloam::gpu
