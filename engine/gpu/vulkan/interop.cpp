// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_interop.h"

#include "engine/gpu/access.h"
#include "engine/gpu/vulkan/barriers.h"
#include "engine/gpu/vulkan/device.h"
#include "engine/gpu/vulkan/startup/features.h"

namespace gloam::gpu {
namespace {

vulkan::VulkanDevice& vulkan_device(Device& device) {
  auto* made = dynamic_cast<vulkan::VulkanDevice*>(&device);
  GLOAM_ASSERT(made != nullptr,
               "Vulkan objects belong to a device made by create_vulkan_device or its sister for hosts");
  return *made;
}

}  // namespace

std::span<const char* const> required_device_extensions() { return {}; }

std::span<const char* const> useful_device_extensions() {
  static constexpr const char* kNames[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
  return kNames;
}

void fill_required_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                            VkPhysicalDeviceVulkan13Features& v13) {
  vulkan::require_features(core, v12, v13);
}

void fill_useful_features(const VkPhysicalDeviceFeatures& core_supported, VkPhysicalDeviceFeatures& core) {
  vulkan::add_useful_features(core_supported, core);
}

Result<std::unique_ptr<Device>> create_vulkan_device_on(const HostDevice& host) {
  return vulkan::VulkanDevice::create_on(host);
}

ImageHandle import_image(Device& device, VkImage image, const ImageDesc& desc) {
  GLOAM_ASSERT(image != VK_NULL_HANDLE, "an image to import must exist");
  return vulkan_device(device).images().adopt(desc, image);
}

HostImageLayout host_image_layout(Access access) {
  GLOAM_ASSERT(access == Access::none || fits_image(access), "only accesses that images can have say a layout");
  const vulkan::AccessFacts& facts = vulkan::facts_of(access);
  return {facts.layout, facts.stages, facts.access};
}

void add_frame_semaphores(Device& device, std::span<const HostSemaphore> waits,
                          std::span<const HostSemaphore> signals) {
  vulkan::Frames& frames = vulkan_device(device).frames();
  for (const HostSemaphore& wait : waits) frames.wait_for(wait.semaphore, wait.value);
  for (const HostSemaphore& signal : signals) frames.signal(signal.semaphore, signal.value);
}

void record_next_frame_into(Device& device, VkCommandBuffer commands) {
  vulkan_device(device).frames().record_next_into(commands);
}

Status host_submitted(Device& device) { return vulkan_device(device).frames().host_submitted(); }

HostSemaphore frame_timeline(Device& device) {
  const vulkan::Frames& frames = vulkan_device(device).frames();
  return {frames.timeline(), frames.number()};
}

}  // namespace gloam::gpu
