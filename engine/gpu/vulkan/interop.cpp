// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_interop.h"

#include "engine/gpu/access.h"
#include "engine/gpu/vulkan/barriers.h"
#include "engine/gpu/vulkan/convert.h"
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

BufferHandle import_buffer(Device& device, VkBuffer buffer, const BufferDesc& desc) {
  GLOAM_ASSERT(buffer != VK_NULL_HANDLE, "a buffer to import must exist");
  return vulkan_device(device).buffers().adopt(desc, buffer);
}

HostImageLayout host_image_layout(Access access) {
  GLOAM_ASSERT(access == Access::none || fits_image(access), "only accesses that images can have say a layout");
  const vulkan::AccessFacts& facts = vulkan::facts_of(access);
  return {facts.layout, facts.stages, facts.access};
}

HostBufferAccess host_buffer_access(Access access) {
  GLOAM_ASSERT(access == Access::none || fits_buffer(access), "only accesses that buffers can have say their stages");
  const vulkan::AccessFacts& facts = vulkan::facts_of(access);
  return {facts.stages, facts.access};
}

VkFormat native_format(Format format) { return vulkan::to_vulkan(format); }

VkBuffer native_buffer(Device& device, BufferHandle buffer) {
  return vulkan_device(device).buffers().get(buffer).buffer;
}

Result<VkImageView> native_view(Device& device, const ImageView& view) {
  vulkan::Images& images = vulkan_device(device).images();
  const ImageDesc& desc = images.get(view.image).desc;
  vulkan::ViewKey key = vulkan::resolve_view(desc, view);
  const bool array = view.as_array || key.layer_count > 1;
  key.type = desc.shape == ImageShape::volume ? VK_IMAGE_VIEW_TYPE_3D
             : array                          ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                              : VK_IMAGE_VIEW_TYPE_2D;
  return images.view(view.image, key);
}

NativeCommands::NativeCommands(CommandList& commands, std::optional<std::uint64_t> revision)
    : commands_(commands), buffer_(static_cast<VkCommandBuffer>(commands.begin_native(revision))) {}

NativeCommands::~NativeCommands() { commands_.end_native(); }

NativeCommands native_commands(CommandList& commands, std::optional<std::uint64_t> revision) {
  return NativeCommands(commands, revision);
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
