// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/gpu/vulkan_interop.h"

namespace host {

struct HostImage {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// What a program with a renderer of its own has anyway: an instance, a device, a queue, images and commands. It links
/// libvulkan and calls it by its prototypes.
class VulkanHost {
 public:
  /// Null when the machine has no device that gloam can use; `why` says what is missing.
  static std::unique_ptr<VulkanHost> open(std::string& why);
  ~VulkanHost();
  VulkanHost(const VulkanHost&) = delete;
  VulkanHost& operator=(const VulkanHost&) = delete;

  /// Everything gloam must know to draw on this device; points into this object.
  [[nodiscard]] gloam::gpu::HostDevice describe();
  [[nodiscard]] const std::string& device_name() const { return name_; }
  [[nodiscard]] bool validates() const { return messenger_ != VK_NULL_HANDLE; }
  /// Destroys everything but the instance, then tells how often validation complained in this object's life.
  [[nodiscard]] std::uint64_t close();

  /// A picture of four bytes a texel, to be drawn into, sampled and copied from.
  [[nodiscard]] HostImage create_image(VkFormat format, std::uint32_t width, std::uint32_t height);
  void destroy(const HostImage& image);
  /// A timeline semaphore that starts at 0; lives until close().
  [[nodiscard]] VkSemaphore create_timeline();
  void signal(VkSemaphore semaphore, std::uint64_t value);
  /// The picture's bytes, rows from the top. `left` is what gloam left it in; `after`: what the copy waits for.
  [[nodiscard]] std::vector<std::uint8_t> read(const HostImage& image, const gloam::gpu::HostImageLayout& left,
                                               const gloam::gpu::HostSemaphore& after);

 private:
  VulkanHost() = default;
  bool make_instance(std::string& why);
  bool make_device(std::string& why);
  [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags);
  void submit_and_wait(VkCommandBuffer commands, const gloam::gpu::HostSemaphore& after);

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::string name_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  std::mutex queue_mutex_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::vector<VkSemaphore> timelines_;
  VkPhysicalDeviceFeatures2 features_ = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan12Features features12_ = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features features13_ = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  std::atomic<std::uint64_t> messages_ = 0;
};

}  // namespace host
