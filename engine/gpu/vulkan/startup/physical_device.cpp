// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/physical_device.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/vulkan/errors.h"
#include "engine/gpu/vulkan/startup/listed.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr VkQueueFlags kQueueNeeds = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;

struct Candidate {
  PhysicalDevice device;
  std::string lacks;  ///< missing requirements
  std::string fault;  ///< a call about it that failed. If both are empty, the device can be used
  [[nodiscard]] bool usable() const { return lacks.empty() && fault.empty(); }
  [[nodiscard]] std::string reason() const { return fault.empty() ? "it lacks " + lacks : fault; }
};

DeviceType type_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::cpu;
    default:
      return DeviceType::other;
  }
}

/// Smaller is better: discrete, integrated, other (virtual machines), cpu.
int rank_of(DeviceType type) {
  switch (type) {
    case DeviceType::discrete:
      return 0;
    case DeviceType::integrated:
      return 1;
    case DeviceType::other:
      return 2;
    case DeviceType::cpu:
      break;
  }
  return 3;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

void add(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

/// The extensions of a device that gloam may use.
struct Extensions {
  bool swapchain = false, push_descriptors = false;
};
/// Returns what has failed, or nothing.
std::string find_extensions(const InstanceFunctions& f, VkPhysicalDevice device, Extensions& found) {
  std::vector<VkExtensionProperties> all;
  const VkResult result = list_all(all, [&](std::uint32_t* count, VkExtensionProperties* items) {
    return f.vkEnumerateDeviceExtensionProperties(device, nullptr, count, items);
  });
  for (const VkExtensionProperties& extension : all) {
    found.swapchain |= std::strcmp(extension.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
    found.push_descriptors |= std::strcmp(extension.extensionName, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME) == 0;
  }
  return result == VK_SUCCESS ? std::string() : "its extensions could not be listed: " + describe(result);
}

constexpr std::uint32_t kLlvmpipeLanes[] = {4, 8};  ///< vectors that llvmpipe tests depth with

void read_properties(const InstanceFunctions& f, PhysicalDevice& device) {
  VkPhysicalDevicePushDescriptorPropertiesKHR push = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR};
  VkPhysicalDeviceVulkan11Properties v11 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                            .pNext = device.push_descriptors ? &push : nullptr};
  VkPhysicalDeviceVulkan12Properties v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES,
                                            .pNext = &v11};
  VkPhysicalDeviceVulkan13Properties v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES,
                                            .pNext = &v12};
  VkPhysicalDeviceProperties2 properties = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &v13};
  f.vkGetPhysicalDeviceProperties2(device.handle, &properties);
  const VkPhysicalDeviceProperties& core = properties.properties;
  device.limits = core.limits;
  device.vendor = core.vendorID;
  device.device = core.deviceID;
  std::copy(std::begin(core.pipelineCacheUUID), std::end(core.pipelineCacheUUID), device.cache_uuid.begin());
  device.max_buffer_size = v13.maxBufferSize;
  device.max_allocation_size = v11.maxMemoryAllocationSize;
  device.max_push_descriptors = push.maxPushDescriptors;
  device.info.name = core.deviceName;
  device.info.driver = std::string(v12.driverName) + " " + v12.driverInfo;
  device.info.subgroup_size = v11.subgroupSize;
  device.info.threads_in_turn = device.info.type == DeviceType::cpu;
  device.crashes_at_depth_tests =
      v12.driverID == VK_DRIVER_ID_MESA_LLVMPIPE &&
      std::find(std::begin(kLlvmpipeLanes), std::end(kLlvmpipeLanes), v11.subgroupSize) == std::end(kLlvmpipeLanes);
  device.compiles_for_uniforms = v12.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
  device.info.max_storage_range = core.limits.maxStorageBufferRange;
  device.info.subpixel_bits = core.limits.subPixelPrecisionBits;
  f.vkGetPhysicalDeviceMemoryProperties(device.handle, &device.memory);
  f.vkGetPhysicalDeviceFeatures2(device.handle, device.features.chain());
}

std::vector<VkQueueFamilyProperties> queue_families(const InstanceFunctions& f, VkPhysicalDevice device) {
  std::uint32_t count = 0;
  f.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  f.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

bool can_draw(std::span<const VkQueueFamilyProperties> families, std::uint32_t index) {
  return index < families.size() && (families[index].queueFlags & kQueueNeeds) == kQueueNeeds;
}

/// Whether the family supports graphics and compute. If so, stores its index and timestamp bits in `device`.
bool take_queue_family(PhysicalDevice& device, std::span<const VkQueueFamilyProperties> families, std::uint32_t index) {
  if (!can_draw(families, index)) return false;
  device.queue_family = index;
  device.timestamp_bits = families[index].timestampValidBits;
  return true;
}

/// Takes the first queue family for graphics and compute that presents to the window, if there is one.
void find_queue_family(const InstanceFunctions& f, const WindowNeeds& window, Candidate& candidate) {
  PhysicalDevice& device = candidate.device;
  const std::vector<VkQueueFamilyProperties> families = queue_families(f, device.handle);
  bool draws = false;
  std::string fault;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (!can_draw(families, i)) continue;
    draws = true;
    VkBool32 presents = VK_TRUE;
    VkResult result = VK_SUCCESS;
    if (window.surface != VK_NULL_HANDLE)
      result = f.vkGetPhysicalDeviceSurfaceSupportKHR(device.handle, i, window.surface, &presents);
    if (result != VK_SUCCESS) {
      fault = "it could not be asked whether it presents to this window: " + describe(result);
    } else if (presents == VK_TRUE) {
      static_cast<void>(take_queue_family(device, families, i));
      return;
    }
  }
  if (candidate.fault.empty()) candidate.fault = fault;
  if (fault.empty())
    add(candidate.lacks, draws ? "a queue that can present to this window" : "a queue for graphics and compute");
}

constexpr std::uint32_t kLeastUniformRange = 65536;
constexpr std::uint32_t kLeastPushConstants = 128;
constexpr std::uint32_t kLeastColorTargets = 5;  // of the geometry buffer with motion; Vulkan guarantees 4

Candidate examine(const Instance& instance, VkPhysicalDevice handle, const WindowNeeds& window) {
  const InstanceFunctions& f = instance.functions();
  Candidate candidate;
  PhysicalDevice& device = candidate.device;
  device.handle = handle;
  VkPhysicalDeviceProperties properties;
  f.vkGetPhysicalDeviceProperties(handle, &properties);
  device.info.name = properties.deviceName;
  device.info.type = type_of(properties.deviceType);
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    candidate.lacks = "Vulkan 1.3";
    return candidate;
  }
  Extensions extensions;
  candidate.fault = find_extensions(f, handle, extensions);
  device.push_descriptors = extensions.push_descriptors;
  read_properties(f, device);
  if (const std::string features = missing_features(device.features); !features.empty()) add(candidate.lacks, features);
  // Uniform blocks of lights are larger than the 16 KiB that Vulkan guarantees; every desktop device has 64 KiB or
  // more.
  if (device.limits.maxUniformBufferRange < kLeastUniformRange) add(candidate.lacks, "uniform buffers of 64 KiB");
  if (device.limits.maxPushConstantsSize < kLeastPushConstants) add(candidate.lacks, "128 bytes of push constants");
  if (std::min(device.limits.maxColorAttachments, device.limits.maxFragmentOutputAttachments) < kLeastColorTargets)
    add(candidate.lacks, "5 colour targets");
  device.can_present = window.present && extensions.swapchain;
  if (candidate.fault.empty() && window.present && !device.can_present)
    add(candidate.lacks, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  find_queue_family(f, window, candidate);
  return candidate;
}

bool fits(const Candidate& candidate, const std::string& wish) {
  const DeviceInfo& info = candidate.device.info;
  if (wish.empty() || wish == "auto") return true;
  if (wish == "cpu") return info.type == DeviceType::cpu;
  if (wish == "gpu") return info.type != DeviceType::cpu;
  return lower(info.name).find(wish) != std::string::npos;
}

Error no_device(std::string_view wish, const std::vector<Candidate>& candidates) {
  std::string there;
  for (const Candidate& c : candidates) {
    std::string item = c.device.info.name + " (" + std::string(name_of(c.device.info.type));
    if (!c.usable()) item += "; " + c.reason();
    add(there, item + ")");
  }
  return {ErrorKind::no_device, "No usable Vulkan device fits \"" + std::string(wish) +
                                    "\"; there is: " + (there.empty() ? "none at all" : there)};
}

}  // namespace

Result<PhysicalDevice> choose_physical_device(const Instance& instance, std::string_view wish,
                                              const WindowNeeds& window) {
  const InstanceFunctions& f = instance.functions();
  std::vector<VkPhysicalDevice> handles;
  const VkResult result = list_all(handles, [&](std::uint32_t* count, VkPhysicalDevice* items) {
    return f.vkEnumeratePhysicalDevices(instance.handle(), count, items);
  });
  if (result != VK_SUCCESS) {
    return Error{ErrorKind::no_device, "The Vulkan devices could not be listed: " + describe(result)};
  }
  std::vector<Candidate> candidates;
  for (VkPhysicalDevice handle : handles) candidates.push_back(examine(instance, handle, window));

  const std::string wanted = lower(wish);
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates) {
    if (!c.fault.empty()) instance.log().warning("The device " + c.device.info.name + " is passed over: " + c.fault);
    if (!c.usable() || !fits(c, wanted)) continue;
    if (best == nullptr || rank_of(c.device.info.type) < rank_of(best->device.info.type)) best = &c;
  }
  if (best == nullptr) return no_device(wish, candidates);
  return best->device;
}

Result<PhysicalDevice> examine_host_device(const Instance& instance, const HostDevice& host) {
  Candidate candidate = examine(instance, host.physical_device, {});
  PhysicalDevice& device = candidate.device;
  const std::string subject = "The host's device " + device.info.name + " cannot be used: ";
  if (!candidate.usable()) return Error{ErrorKind::no_device, subject + candidate.reason()};
  if (!take_queue_family(device, queue_families(instance.functions(), device.handle), host.queue_family)) {
    return Error{ErrorKind::no_device, subject + "its queue family " + std::to_string(host.queue_family) +
                                           " is not one for graphics and compute"};
  }
  const auto enabled = [&](const char* name) {
    return std::any_of(host.enabled_extensions.begin(), host.enabled_extensions.end(),
                       [&](const char* extension) { return std::strcmp(extension, name) == 0; });
  };
  device.features = host.enabled_features == nullptr ? Features() : features_of_chain(*host.enabled_features);
  device.can_present = enabled(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  device.push_descriptors = enabled(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  std::string absent = missing_features(device.features);
  for (const char* name : required_device_extensions()) {
    if (!enabled(name)) add(absent, name);
  }
  if (!absent.empty()) {
    return Error{ErrorKind::no_device, subject + "vkCreateDevice must enable " + absent +
                                           " (see required_device_extensions and fill_required_features)"};
  }
  return device;
}

}  // namespace gloam::gpu::vulkan
