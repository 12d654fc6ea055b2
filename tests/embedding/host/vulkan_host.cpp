// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "vulkan_host.h"

#include "checks.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace host {
namespace {

constexpr const char* kValidation = "VK_LAYER_KHRONOS_validation";

void require(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "the host failed: %s: VkResult %d\n", what, static_cast<int>(result));
  std::exit(1);
}

bool has_layer(const char* name) {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const VkLayerProperties& layer : layers) {
    if (std::strcmp(layer.layerName, name) == 0) return true;
  }
  return false;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  ++*static_cast<std::atomic<std::uint64_t>*>(user);
  std::fprintf(stderr, "validation: %s\n", data->pMessage);
  return VK_FALSE;
}

template <class Function>
Function find(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

bool VulkanHost::make_instance(std::string& why) {
  std::uint32_t version = 0;
  if (vkEnumerateInstanceVersion(&version) != VK_SUCCESS || version < VK_API_VERSION_1_3) {
    why = "the Vulkan loader is older than 1.3";
    return false;
  }
  const bool validate = has_layer(kValidation);
  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  const VkValidationFeatureEnableEXT checks[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT features = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                            .enabledValidationFeatureCount = 1,
                                            .pEnabledValidationFeatures = checks};
  const VkApplicationInfo application = {
      .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "a host", .apiVersion = VK_API_VERSION_1_3};
  const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pNext = validate ? &features : nullptr,
                                     .pApplicationInfo = &application,
                                     .enabledLayerCount = validate ? 1u : 0u,
                                     .ppEnabledLayerNames = &kValidation,
                                     .enabledExtensionCount = validate ? 2u : 0u,
                                     .ppEnabledExtensionNames = extensions};
  if (vkCreateInstance(&info, nullptr, &instance_) != VK_SUCCESS) {
    why = "no Vulkan driver is installed";
    return false;
  }
  if (!validate) return true;
  const VkDebugUtilsMessengerCreateInfoEXT messenger = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = &on_message,
      .pUserData = &messages_};
  const auto create = find<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
  require(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  return true;
}

bool VulkanHost::make_device(std::string& why) {
  std::uint32_t count = 1;
  const VkResult listed = vkEnumeratePhysicalDevices(instance_, &count, &physical_);
  if ((listed != VK_SUCCESS && listed != VK_INCOMPLETE) || count == 0) {
    why = "there is no Vulkan device";
    return false;
  }
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  name_ = properties.deviceName;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  constexpr VkQueueFlags kNeeds = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  while (family_ < count && (families[family_].queueFlags & kNeeds) != kNeeds) ++family_;

  // A host would enable its own features here; gloam adds the features that it requires. The
  // optional features and VK_KHR_push_descriptor stay off: gloam must draw the same without them.
  features_.pNext = &features12_;
  features12_.pNext = &features13_;
  gloam::gpu::fill_required_features(features_.features, features12_, features13_);
  const auto extensions = gloam::gpu::required_device_extensions();

  const float priority = 1.0f;
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = family_,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
  const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                   .pNext = &features_,
                                   .queueCreateInfoCount = 1,
                                   .pQueueCreateInfos = &queue,
                                   .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                   .ppEnabledExtensionNames = extensions.data()};
  if (vkCreateDevice(physical_, &info, nullptr, &device_) != VK_SUCCESS) {
    why = "the device " + name_ + " lacks what gloam requires";
    return false;
  }
  vkGetDeviceQueue(device_, family_, 0, &queue_);
  const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                        .queueFamilyIndex = family_};
  require(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
  return true;
}

std::unique_ptr<VulkanHost> VulkanHost::open_or_skip() {
  std::string why;
  std::unique_ptr<VulkanHost> opened = open(why);
  if (opened != nullptr) return opened;
  std::printf("skipped: %s\n", why.c_str());
  std::exit(kSkipped);
}

std::unique_ptr<VulkanHost> VulkanHost::open(std::string& why) {
  std::unique_ptr<VulkanHost> host(new VulkanHost());
  if (!host->make_instance(why) || !host->make_device(why)) return nullptr;
  return host;
}

std::uint64_t VulkanHost::close() {
  if (device_ != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device_);
    for (VkSemaphore semaphore : timelines_) vkDestroySemaphore(device_, semaphore, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);  // validation reports leaked objects here
    device_ = VK_NULL_HANDLE;
  }
  return messages_;
}

VulkanHost::~VulkanHost() {
  static_cast<void>(close());
  if (messenger_ != VK_NULL_HANDLE) {
    find<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_,
                                                                                            nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

gloam::gpu::HostDevice VulkanHost::describe() {
  gloam::gpu::HostDevice description;
  description.instance = instance_;
  description.physical_device = physical_;
  description.device = device_;
  description.queue = queue_;
  description.queue_family = family_;
  description.get_instance_proc_addr = &vkGetInstanceProcAddr;
  description.api_version = VK_API_VERSION_1_3;
  description.enabled_extensions = gloam::gpu::required_device_extensions();
  description.enabled_features = &features_;
  description.queue_mutex = &queue_mutex_;
  return description;
}

VkDeviceMemory VulkanHost::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
  VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size};
  while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
         (memory.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags) {
    ++info.memoryTypeIndex;
  }
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  require(vkAllocateMemory(device_, &info, nullptr, &allocated), "vkAllocateMemory");
  return allocated;
}

HostBuffer VulkanHost::create_buffer(VkBufferUsageFlags usage, std::span<const std::byte> bytes) {
  const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes.size(), .usage = usage};
  HostBuffer buffer = {.size = bytes.size()};
  require(vkCreateBuffer(device_, &info, nullptr, &buffer.buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer.buffer, &needs);
  buffer.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  require(vkBindBufferMemory(device_, buffer.buffer, buffer.memory, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  require(vkMapMemory(device_, buffer.memory, 0, bytes.size(), 0, &mapped), "vkMapMemory");
  std::memcpy(mapped, bytes.data(), bytes.size());
  vkUnmapMemory(device_, buffer.memory);
  return buffer;
}

void VulkanHost::destroy(const HostBuffer& buffer) {
  vkDestroyBuffer(device_, buffer.buffer, nullptr);
  vkFreeMemory(device_, buffer.memory, nullptr);
}

HostImage VulkanHost::create_image(VkFormat format, std::uint32_t width, std::uint32_t height) {
  const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = format,
                                  .extent = {width, height, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = VK_SAMPLE_COUNT_1_BIT,
                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                           VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
  HostImage image = {.format = format, .width = width, .height = height};
  require(vkCreateImage(device_, &info, nullptr, &image.image), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_, image.image, &needs);
  image.memory = allocate(needs, 0);
  require(vkBindImageMemory(device_, image.image, image.memory, 0), "vkBindImageMemory");
  return image;
}

void VulkanHost::destroy(const HostImage& image) {
  vkDestroyImage(device_, image.image, nullptr);
  vkFreeMemory(device_, image.memory, nullptr);
}

VkSemaphore VulkanHost::create_timeline() {
  const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                          .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  require(vkCreateSemaphore(device_, &info, nullptr, &semaphore), "vkCreateSemaphore");
  timelines_.push_back(semaphore);
  return semaphore;
}

void VulkanHost::signal(VkSemaphore semaphore, std::uint64_t value) {
  const VkSemaphoreSignalInfo info = {
      .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = semaphore, .value = value};
  require(vkSignalSemaphore(device_, &info), "vkSignalSemaphore");
}

void VulkanHost::submit_and_wait(VkCommandBuffer commands, const gloam::gpu::HostSemaphore& after) {
  const VkSemaphoreSubmitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                      .semaphore = after.semaphore,
                                      .value = after.value,
                                      .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
  const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                            .commandBuffer = commands};
  const VkSubmitInfo2 info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                              .waitSemaphoreInfoCount = after.semaphore == VK_NULL_HANDLE ? 0u : 1u,
                              .pWaitSemaphoreInfos = &wait,
                              .commandBufferInfoCount = 1,
                              .pCommandBufferInfos = &buffer};
  const std::lock_guard lock(queue_mutex_);
  require(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  require(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
}

VkCommandBuffer VulkanHost::begin_commands() {
  const VkCommandBufferAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = pool_,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  require(vkAllocateCommandBuffers(device_, &allocation, &commands), "vkAllocateCommandBuffers");
  const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  require(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  return commands;
}

void VulkanHost::submit(VkCommandBuffer commands) {
  require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  const VkCommandBufferSubmitInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                            .commandBuffer = commands};
  const VkSubmitInfo2 info = {
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer};
  const std::lock_guard lock(queue_mutex_);
  require(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
}

namespace {

VkImageMemoryBarrier2 layout_barrier(const HostImage& image, const gloam::gpu::HostImageLayout& from,
                                     const gloam::gpu::HostImageLayout& to) {
  return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
          .srcStageMask = from.stages,
          .srcAccessMask = from.access,
          .dstStageMask = to.stages,
          .dstAccessMask = to.access,
          .oldLayout = from.layout,
          .newLayout = to.layout,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = image.image,
          .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
}

void record(VkCommandBuffer commands, const VkImageMemoryBarrier2& barrier) {
  const VkDependencyInfo dependency = {
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

void VulkanHost::write(const HostImage& image, const std::vector<std::uint8_t>& texels,
                       const gloam::gpu::HostImageLayout& layout) {
  const VkBufferCreateInfo buffer_info = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = texels.size(), .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
  VkBuffer buffer = VK_NULL_HANDLE;
  require(vkCreateBuffer(device_, &buffer_info, nullptr, &buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer, &needs);
  const VkDeviceMemory memory =
      allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  require(vkBindBufferMemory(device_, buffer, memory, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  require(vkMapMemory(device_, memory, 0, texels.size(), 0, &mapped), "vkMapMemory");
  std::memcpy(mapped, texels.data(), texels.size());
  const gloam::gpu::HostImageLayout written = gloam::gpu::host_image_layout(gloam::gpu::Access::transfer_write);
  const VkCommandBuffer commands = begin_commands();
  record(commands, layout_barrier(image, {}, written));
  const VkBufferImageCopy region = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {image.width, image.height, 1}};
  vkCmdCopyBufferToImage(commands, buffer, image.image, written.layout, 1, &region);
  record(commands, layout_barrier(image, written, layout));
  require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  submit_and_wait(commands, {});
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
  vkDestroyBuffer(device_, buffer, nullptr);
  vkFreeMemory(device_, memory, nullptr);
}

std::vector<std::uint8_t> VulkanHost::read(const HostImage& image, const gloam::gpu::HostImageLayout& left,
                                           const gloam::gpu::HostSemaphore& after) {
  const VkDeviceSize bytes = VkDeviceSize{image.width} * image.height * 4;
  const VkBufferCreateInfo buffer_info = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
  VkBuffer buffer = VK_NULL_HANDLE;
  require(vkCreateBuffer(device_, &buffer_info, nullptr, &buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer, &needs);
  const VkDeviceMemory memory =
      allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  require(vkBindBufferMemory(device_, buffer, memory, 0), "vkBindBufferMemory");

  const VkCommandBuffer commands = begin_commands();
  record(commands, layout_barrier(image, left, gloam::gpu::host_image_layout(gloam::gpu::Access::transfer_read)));
  const VkBufferImageCopy region = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {image.width, image.height, 1}};
  vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &region);
  require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  submit_and_wait(commands, after);

  std::vector<std::uint8_t> texels(bytes);
  void* mapped = nullptr;
  require(vkMapMemory(device_, memory, 0, bytes, 0, &mapped), "vkMapMemory");
  std::memcpy(texels.data(), mapped, texels.size());
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
  vkDestroyBuffer(device_, buffer, nullptr);
  vkFreeMemory(device_, memory, nullptr);
  return texels;
}

}  // namespace host
