// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>
// GLFW declares its functions for Vulkan after Vulkan's own types.
#include <GLFW/glfw3.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/gpu_device.h"

namespace gloam::gpu {

/// A window of 200×100 pixels on the display of the environment.
class TestWindow {
 public:
  TestWindow() {
    if (glfwInit() != GLFW_TRUE || glfwVulkanSupported() != GLFW_TRUE) return;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(200, 100, "test", nullptr, nullptr);
  }
  ~TestWindow() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }
  TestWindow(const TestWindow&) = delete;
  TestWindow& operator=(const TestWindow&) = delete;

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
  GLFWwindow* window_ = nullptr;
};

}  // namespace gloam::gpu
