// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// Runs gloam on a VkDevice that the host application has created. This is the only public header with Vulkan types.
// gloam makes every Vulkan call through the host's vkGetInstanceProcAddr and defines no Vulkan symbol, so the host may
// link libvulkan, volk or any other loader.
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

/// The device extensions that the host must enable in vkCreateDevice: none. No instance extension is required.
[[nodiscard]] std::span<const char* const> required_device_extensions();
/// The device extensions that gloam uses if the host enables them: VK_KHR_push_descriptor.
[[nodiscard]] std::span<const char* const> useful_device_extensions();

/// Sets the features that gloam requires to VK_TRUE and leaves all other features unchanged. The host owns and chains
/// the structures; sType and pNext are not touched.
void fill_required_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                            VkPhysicalDeviceVulkan13Features& v13);
/// Sets the optional features that gloam uses (anisotropic filtering, …) to VK_TRUE where the device supports them.
/// core_supported comes from vkGetPhysicalDeviceFeatures2.
void fill_useful_features(const VkPhysicalDeviceFeatures& core_supported, VkPhysicalDeviceFeatures& core);

/// A device that the host has created. The host owns all handles; they must outlive the gpu::Device created on them.
struct HostDevice {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;  ///< receives all of gloam's work
  std::uint32_t queue_family = 0;  ///< of `queue`; must support graphics and compute
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  std::uint32_t api_version = VK_API_VERSION_1_3;  ///< VkApplicationInfo::apiVersion of the instance; ≥ 1.3
  /// The extensions and features that the host passed to vkCreateDevice; Vulkan cannot be queried for them. Read during
  /// creation only. The features' pNext chain may hold the structures of whole Vulkan versions or of single features;
  /// other structures are skipped.
  std::span<const char* const> enabled_extensions;
  const VkPhysicalDeviceFeatures2* enabled_features = nullptr;
  /// gloam locks this mutex around each use of `queue`. Set it if other threads of the host use the queue at the same
  /// time. Null: the host must not use the queue while a call to gloam's Device or Renderer runs.
  std::mutex* queue_mutex = nullptr;
  std::string cache_directory;         ///< as VulkanOptions::cache_directory
  std::size_t retained_pipelines = 0;  ///< as VulkanOptions::retained_pipelines
  LogSink* log = nullptr;              ///< must outlive the device
};

/// Creates a gpu::Device on the host's device. The host's objects are never destroyed, renamed or waited for.
/// Validation messages go to the host's messenger, so Device::validation_messages stays 0. Fails with
/// ErrorKind::no_device; the error names every feature and extension that the device lacks or that the host has not
/// enabled.
[[nodiscard]] Result<std::unique_ptr<Device>> create_vulkan_device_on(const HostDevice& host);

// The functions below take a device made by create_vulkan_device_on or create_vulkan_device.

/// Returns a gloam handle for an image of the host. `desc` describes the image: its size, layers, mips, usage flags
/// that it was created with, and its format (or another format if it was created with
/// VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT). The image must be two-dimensional, with one sample and optimal tiling. It must
/// be usable on the device's queue family: concurrent, or exclusive and owned by this family or by none.
/// Device::destroy removes the handle and its views, never the image. The image must live until all frames that use it
/// have finished on the GPU.
[[nodiscard]] ImageHandle import_image(Device& device, VkImage image, const ImageDesc& desc);

/// The layout of an image that gloam has left ready for an access, and the stages and accesses that a later barrier
/// must wait for.
struct HostImageLayout {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};
/// access: one that images support, or Access::none (undefined layout). A host barrier after gloam's work uses the
/// result as its source (oldLayout, srcStageMask, srcAccessMask). A host barrier before gloam's work uses it as its
/// destination.
[[nodiscard]] HostImageLayout host_image_layout(Access access);

/// A semaphore for synchronisation with work on other queues. Work on the same queue needs none: gloam's barriers wait
/// for everything submitted before, and a host barrier with host_image_layout as its source waits for gloam.
struct HostSemaphore {
  VkSemaphore semaphore = VK_NULL_HANDLE;
  std::uint64_t value = 0;  ///< of a timeline semaphore; ignored for a binary semaphore
};

/// Adds semaphores to the frame being recorded: all of its work waits for `waits`, and `signals` are signalled after
/// all of its work. Call it between begin_frame and submit_frame; with a Renderer, from ViewTarget::acquire. A frame
/// that is abandoned while it is being recorded still waits and signals.
void add_frame_semaphores(Device& device, std::span<const HostSemaphore> waits,
                          std::span<const HostSemaphore> signals = {});

/// The next frame (begin_frame; with a Renderer, the next call of render) is recorded into a command buffer of the host
/// and not submitted. The command buffer is a primary one for `queue_family`; the host has begun it, and records before
/// and after gloam what it likes, outside of rendering. Then it ends the command buffer, submits it once to
/// HostDevice::queue, and calls host_submitted before it uses gloam's device or renderer again. Such a frame has no
/// semaphores of its own (add_frame_semaphores, swapchains): those of the host's submission hold for it.
///
/// If render returns an error, its commands may be incomplete: the host resets the command buffer, and must not call
/// host_submitted.
void record_next_frame_into(Device& device, VkCommandBuffer commands);
/// Tells that the host has submitted the frame that was recorded into its command buffer. Submits a signal of gloam's
/// timeline to the same queue.
[[nodiscard]] Status host_submitted(Device& device);

/// gloam's timeline semaphore, and the value it reaches when all work submitted so far has finished. Work on another
/// queue, or vkWaitSemaphores, can wait for this value. The semaphore lives as long as the device; the host must not
/// signal it.
[[nodiscard]] HostSemaphore frame_timeline(Device& device);

}  // namespace gloam::gpu
