// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/context.h"

#include <span>
#include <string>
#include <vector>

#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {

Result<std::unique_ptr<Context>> Context::create(const Instance& instance, const PhysicalDevice& physical) {
  std::unique_ptr<Context> context(new Context(instance, physical));
  Features features = features_to_enable(physical.features);
  const std::span<const char* const> required = required_device_extensions();
  std::vector<const char*> extensions(required.begin(), required.end());
  if (physical.push_descriptors) extensions.push_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  if (physical.can_present) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);

  const float priority = 1.0f;
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = physical.queue_family,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
  const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                   .pNext = features.chain(),
                                   .queueCreateInfoCount = 1,
                                   .pQueueCreateInfos = &queue,
                                   .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                   .ppEnabledExtensionNames = extensions.data()};
  const InstanceFunctions& f = instance.functions();
  const VkResult result =
      null_on_failure(f.vkCreateDevice(physical.handle, &info, nullptr, &context->device), context->device);
  if (result != VK_SUCCESS) return failure("The device " + physical.info.name + " could not be opened", result);
  GLOAM_TRY(context->load_functions());
  context->vk.vkGetDeviceQueue(context->device, physical.queue_family, 0, &context->queue);
  context->set_name(VK_OBJECT_TYPE_QUEUE, context->queue, "main queue");
  return context;
}

Result<std::unique_ptr<Context>> Context::adopt(const Instance& instance, const PhysicalDevice& physical,
                                                const HostDevice& host) {
  std::unique_ptr<Context> context(new Context(instance, physical));
  context->owned_ = false;
  context->device = host.device;
  context->queue = host.queue;
  if (host.allocation_callbacks != nullptr) {
    context->callbacks_ = *host.allocation_callbacks;
    context->allocation = &context->callbacks_;
  }
  if (host.queue_mutex != nullptr) context->queue_mutex_ = host.queue_mutex;
  GLOAM_TRY(context->load_functions());
  return context;
}

Status Context::load_functions() {
  const Result<DeviceFunctions> functions = load_device_functions(instance_functions().vkGetDeviceProcAddr, device);
  if (!functions) return functions.error();
  vk = *functions;
  return {};
}

void Context::set_object_name(VkObjectType type, std::uint64_t object, std::string_view name) const {
  const PFN_vkSetDebugUtilsObjectNameEXT set = instance_functions().vkSetDebugUtilsObjectNameEXT;
  if (set == nullptr || object == 0) return;
  const std::string text(name);
  const VkDebugUtilsObjectNameInfoEXT info = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                              .objectType = type,
                                              .objectHandle = object,
                                              .pObjectName = text.c_str()};
  set(device, &info);
}

Context::~Context() {
  if (owned_ && device != VK_NULL_HANDLE && vk.vkDestroyDevice != nullptr) vk.vkDestroyDevice(device, nullptr);
}

}  // namespace gloam::gpu::vulkan
