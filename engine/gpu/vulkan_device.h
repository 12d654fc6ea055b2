// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam::gpu {

struct VulkanOptions {
  /// "auto" (discrete, integrated, then cpu), "cpu", "gpu", or part of a device's name (any case).
  std::string device = "auto";
  bool validate = false;        ///< validation layer with synchronization checks; every message is logged and counted
  std::string cache_directory;  ///< where compiled pipelines are kept between runs; empty: nowhere
  LogSink* log = nullptr;       ///< must outlive the device
  /// Instance extensions a window system asks for; empty: no window.
  std::vector<std::string> window_extensions;
};

/// Fails with ErrorKind::no_device when no device fits, naming what there is.
[[nodiscard]] Result<std::unique_ptr<Device>> create_vulkan_device(const VulkanOptions& options);

/// Pictures of a window, shown one after another.
class Swapchain {
 public:
  virtual ~Swapchain() = default;
  /// Fits the size in pixels; 0×0 (minimised) keeps nothing and makes `acquire` give no image.
  [[nodiscard]] virtual Status resize(std::uint32_t width, std::uint32_t height) = 0;
  /// Between begin_frame and submit_frame: the image to fill (it must end in Access::present), or none when the window
  /// is minimised or has changed size (call resize, then try again next frame).
  [[nodiscard]] virtual Result<ImageHandle> acquire() = 0;
  /// After submit_frame.
  [[nodiscard]] virtual Status present() = 0;
};

/// `create_surface` receives the VkInstance and returns a VkSurfaceKHR as an integer, or 0. The device must have been
/// made with the window's extensions and must outlive the swapchain.
[[nodiscard]] Result<std::unique_ptr<Swapchain>> create_swapchain(
    Device& device, const std::function<std::uint64_t(void* instance)>& create_surface);

}  // namespace gloam::gpu
