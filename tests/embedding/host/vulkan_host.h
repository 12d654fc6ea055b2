// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
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

struct HostBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize size = 0;
};

/// The Vulkan objects of a program with its own renderer: instance, device, queue, images and commands. It links
/// libvulkan and calls its prototypes.
class VulkanHost {
 public:
  /// Prints what is missing and exits with kSkipped if the machine has no device that gloam can use.
  static std::unique_ptr<VulkanHost> open_or_skip();
  ~VulkanHost();
  VulkanHost(const VulkanHost&) = delete;
  VulkanHost& operator=(const VulkanHost&) = delete;

  /// The description of this device for gloam. It points into this object.
  [[nodiscard]] gloam::gpu::HostDevice describe();
  [[nodiscard]] VkDevice device() const { return device_; }
  [[nodiscard]] const std::string& device_name() const { return name_; }
  [[nodiscard]] bool validates() const { return messenger_ != VK_NULL_HANDLE; }
  /// Destroys everything except the instance. Returns the number of validation messages in this object's lifetime.
  [[nodiscard]] std::uint64_t close();

  /// Creates a buffer with these bytes, which the CPU has written once the next submission begins.
  [[nodiscard]] HostBuffer create_buffer(VkBufferUsageFlags usage, std::span<const std::byte> bytes);
  void destroy(const HostBuffer& buffer);
  /// Creates an image of four bytes per texel that can be rendered to, sampled and copied from.
  [[nodiscard]] HostImage create_image(VkFormat format, std::uint32_t width, std::uint32_t height);
  void destroy(const HostImage& image);
  /// Fills an image with texels of four bytes, rows from the top, and leaves it in `layout`.
  void write(const HostImage& image, const std::vector<std::uint8_t>& texels,
             const gloam::gpu::HostImageLayout& layout);
  /// Begins a command buffer. submit ends and submits it, without waiting; it is freed by close().
  [[nodiscard]] VkCommandBuffer begin_commands();
  void submit(VkCommandBuffer commands);
  /// Creates a timeline semaphore with value 0. It lives until close().
  [[nodiscard]] VkSemaphore create_timeline();
  void signal(VkSemaphore semaphore, std::uint64_t value);
  /// Returns the image's texels, rows from the top. `left`: the layout that gloam left the image in. `after`: the
  /// semaphore that the copy waits for.
  [[nodiscard]] std::vector<std::uint8_t> read(const HostImage& image, const gloam::gpu::HostImageLayout& left,
                                               const gloam::gpu::HostSemaphore& after);

 private:
  VulkanHost() = default;
  /// Returns null if the machine has no device that gloam can use; `why` then names what is missing.
  static std::unique_ptr<VulkanHost> open(std::string& why);
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
