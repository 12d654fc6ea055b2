// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "engine/gpu/vulkan/device.h"
#include "engine/gpu/vulkan_device.h"

namespace gloam::gpu::vulkan {

/// The images of a window with 8 bits per channel. They have a UNORM format and are displayed as stored, so shaders
/// must encode for the display. Presentation is synchronised with the display (FIFO).
class VulkanSwapchain final : public Swapchain {
 public:
  static Result<std::unique_ptr<Swapchain>> create(VulkanDevice& device, VkSurfaceKHR surface);
  ~VulkanSwapchain() override;

  [[nodiscard]] Status resize(std::uint32_t width, std::uint32_t height) override;
  [[nodiscard]] Result<ImageHandle> acquire() override;
  [[nodiscard]] Status present() override;

 private:
  static constexpr std::uint32_t kNone = ~0u;

  VulkanSwapchain(VulkanDevice& device, VkSurfaceKHR surface) : device_(device), user_(device), surface_(surface) {}
  Status check_surface();
  Status make_acquire_semaphores();
  Status make_swapchain(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent);
  Status adopt_images(VkExtent2D extent);
  Status replace_ready();
  void forget_images();
  ImageHandle use_acquired(VkSemaphore ready);
  Result<VkSemaphore> make_semaphore(std::string_view name);

  VulkanDevice& device_;
  DeviceUser user_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_ = {};
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  bool stale_ = true;  ///< the window has another size, or there is no swapchain
  std::uint32_t acquired_ = kNone;
  VkSemaphore ready_ = VK_NULL_HANDLE;    ///< what the frame that acquired the picture waits for
  FrameFate fate_ = FrameFate::recorded;  ///< what has become of that frame
  std::vector<ImageHandle> images_;
  std::vector<VkSemaphore> rendered_;  ///< one per image: presenting waits for it
  std::array<VkSemaphore, Device::kFramesInFlight> available_ = {};
};

}  // namespace gloam::gpu::vulkan
