// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// The one public header with Vulkan's types, for hosts that have a VkDevice of their own. gloam makes every call
// through the host's vkGetInstanceProcAddr and defines no Vulkan symbol, so the host may link libvulkan, volk or
// anything else.
#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam::gpu {

/// Device extensions that the host's vkCreateDevice must name; no instance extension is required.
[[nodiscard]] std::span<const char* const> required_device_extensions();

/// Switches on what gloam cannot do without and leaves all else as it is. The structures are the host's, chained by the
/// host; sType and pNext are not touched.
void fill_required_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                            VkPhysicalDeviceVulkan13Features& v13);
/// Switches on what gloam uses when it is there (anisotropic filtering, …), as far as vkGetPhysicalDeviceFeatures2 said
/// that it is there.
void fill_useful_features(const VkPhysicalDeviceFeatures& core_supported,
                          const VkPhysicalDeviceVulkan12Features& v12_supported, VkPhysicalDeviceFeatures& core,
                          VkPhysicalDeviceVulkan12Features& v12);

/// A device that a host has opened. All handles stay the host's and must outlive the gpu::Device made on them.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;  ///< takes all of gloam's work
  std::uint32_t queue_family = 0;  ///< of `queue`; for graphics and compute
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  std::uint32_t api_version = VK_API_VERSION_1_3;  ///< VkApplicationInfo::apiVersion of the instance; ≥ 1.3
  /// What vkCreateDevice was given; Vulkan cannot be asked for it afterwards. Read during creation only. The features'
  /// pNext chain may hold structures of whole versions or of single features; others are skipped.
  std::span<const char* const> enabled_extensions;
  const VkPhysicalDeviceFeatures2* enabled_features = nullptr;
  /// Held by gloam around each use of `queue`, for a host that uses it on other threads meanwhile. Null: the host does
  /// not use the queue while a call of gloam's Device or Renderer runs.
  std::mutex* queue_mutex = nullptr;
  std::string cache_directory;  ///< as VulkanOptions::cache_directory
  LogSink* log = nullptr;       ///< must outlive the device
};

/// A gpu::Device on the host's. Nothing of the host's is destroyed, renamed or waited for; validation messages go to
/// the host's own messenger, so Device::validation_messages stays 0. ErrorKind::no_device names every feature and
/// extension that the device lacks or that the host has not enabled.
[[nodiscard]] Result<std::unique_ptr<Device>> create_vulkan_device_on(const HostDevice& host);

// The functions below take a device made by create_vulkan_device_on or create_vulkan_device.

/// The host's image under a handle of gloam's. `desc` says what the image is: size, layers, mips, a usage it was made
/// with, and its format, or another one if it was made with VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT. One sample, optimal
/// tiling, two dimensions. It must be usable on the device's queue family: exclusive and owned by it or by none, or
/// concurrent. Device::destroy takes away the handle and its views, never the image; the image must live until the
/// frames that use it have ended.
[[nodiscard]] ImageHandle import_image(Device& device, VkImage image, const ImageDesc& desc);

/// What an image is in, and what a barrier must wait for, when gloam has left it ready for an access.
struct HostImageLayout {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
/// access: one that images can have, or Access::none (undefined layout). Both sides use it: a host's barrier after
/// gloam has this as its source (oldLayout, srcStageMask, srcAccessMask), one before gloam as its target.
[[nodiscard]] HostImageLayout host_image_layout(Access access);

/// Work on the same queue needs none of what follows: gloam's barriers wait for everything submitted before, and the
/// host's barrier with host_image_layout as its source waits for gloam.
struct HostSemaphore {
  VkSemaphore semaphore = VK_NULL_HANDLE;
  std::uint64_t value = 0;  ///< of a timeline semaphore; ignored for a binary one
};

/// Semaphores of the frame being recorded: all of its work waits for `waits`, and `signals` follow all of its work.
/// Between begin_frame and submit_frame, that is from ViewTarget::acquire; a frame that is given up midway waits and
/// signals too.
void add_frame_semaphores(Device& device, std::span<const HostSemaphore> waits,
                          std::span<const HostSemaphore> signals = {});

/// gloam's own timeline semaphore, and the value it reaches when all that was submitted so far has ended: what work on
/// another queue, or vkWaitSemaphores, waits for. Lives as long as the device; the host never signals it.
[[nodiscard]] HostSemaphore frame_timeline(Device& device);

}  // namespace gloam::gpu
