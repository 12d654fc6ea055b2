// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "engine/gpu/vulkan/errors.h"
#include "engine/gpu/vulkan/startup/listed.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kDebugUtils = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;

Result<bool> layer_installed(const GlobalFunctions& f, const char* name) {
  std::vector<VkLayerProperties> layers;
  const VkResult result = list_all(layers, f.vkEnumerateInstanceLayerProperties);
  if (result != VK_SUCCESS) return failure("Vulkan could not list its layers", result);
  return std::ranges::any_of(layers, [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

Result<std::vector<VkExtensionProperties>> available_extensions(const GlobalFunctions& f) {
  std::vector<VkExtensionProperties> extensions;
  const VkResult result = list_all(extensions, [&](std::uint32_t* count, VkExtensionProperties* items) {
    return f.vkEnumerateInstanceExtensionProperties(nullptr, count, items);
  });
  if (result != VK_SUCCESS) return failure("Vulkan could not list its extensions", result);
  return extensions;
}

Status check_version(const GlobalFunctions& f) {
  std::uint32_t version = 0;
  const VkResult result = f.vkEnumerateInstanceVersion(&version);
  if (result != VK_SUCCESS) return failure("Vulkan could not tell its version", result);
  if (version >= VK_API_VERSION_1_3) return {};
  return Error{ErrorKind::no_device, "The Vulkan loader is older than version 1.3"};
}

/// The extensions and layers to enable.
struct Enabled {
  std::vector<const char*> extensions, layers;
};
Result<Enabled> choose_enabled(const GlobalFunctions& f, const VulkanOptions& options) {
  const auto available = available_extensions(f);
  if (!available) return available.error();
  const auto has = [&](const char* name) {
    return std::ranges::any_of(*available, [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
  };
  Enabled enabled;
  for (const std::string& name : options.window_extensions) {
    if (!has(name.c_str())) {
      return Error{ErrorKind::no_device, "The window needs the Vulkan extension " + name + ", which is not there"};
    }
    enabled.extensions.push_back(name.c_str());
  }
  if (options.validate) {
    const Result<bool> installed = layer_installed(f, kValidationLayer);
    if (!installed) return installed.error();
    if (!*installed) {
      return Error{ErrorKind::failed, std::string("Validation was asked for, but the layer ") + kValidationLayer +
                                          " is not installed (package vulkan-validationlayers)"};
    }
    enabled.layers.push_back(kValidationLayer);
    enabled.extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  if (options.validate || has(kDebugUtils)) enabled.extensions.push_back(kDebugUtils);
  return enabled;
}

}  // namespace

Result<std::unique_ptr<Instance>> Instance::create(const VulkanOptions& options) {
  std::unique_ptr<Instance> instance(new Instance(options.log != nullptr ? *options.log : null_log()));
  GLOAM_TRY(instance->make(options));
  return instance;
}

Result<std::unique_ptr<Instance>> Instance::adopt(const HostDevice& host) {
  std::unique_ptr<Instance> instance(new Instance(host.log != nullptr ? *host.log : null_log()));
  instance->instance_ = host.instance;
  instance->owned_ = false;
  GLOAM_TRY(instance->load_functions(host.get_instance_proc_addr));
  return instance;
}

Status Instance::load_functions(PFN_vkGetInstanceProcAddr get) {
  const Result<InstanceFunctions> functions = load_instance_functions(get, instance_);
  if (!functions) return functions.error();
  functions_ = *functions;
  return {};
}

Status Instance::make(const VulkanOptions& options) {
  const PFN_vkGetInstanceProcAddr loader =
      options.get_instance_proc_addr != nullptr
          ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(options.get_instance_proc_addr)
          : find_loader();
  if (loader == nullptr) {
    return Error{ErrorKind::no_device, "There is no Vulkan loader (libvulkan) on this machine"};
  }
  const Result<GlobalFunctions> global = load_global_functions(loader);
  if (!global) return global.error();
  GLOAM_TRY(check_version(*global));
  const Result<Enabled> enable = choose_enabled(*global, options);
  if (!enable) return enable.error();
  const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .pApplicationName = "gloam",
                                         .pEngineName = "gloam",
                                         .apiVersion = VK_API_VERSION_1_3};
  const std::array enabled = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT features = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                            .enabledValidationFeatureCount = enabled.size(),
                                            .pEnabledValidationFeatures = enabled.data()};
  const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pNext = options.validate ? &features : nullptr,
                                     .pApplicationInfo = &application,
                                     .enabledLayerCount = static_cast<std::uint32_t>(enable->layers.size()),
                                     .ppEnabledLayerNames = enable->layers.data(),
                                     .enabledExtensionCount = static_cast<std::uint32_t>(enable->extensions.size()),
                                     .ppEnabledExtensionNames = enable->extensions.data()};
  const VkResult result = null_on_failure(global->vkCreateInstance(&info, nullptr, &instance_), instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return Error{ErrorKind::no_device, "No Vulkan driver is installed on this machine"};
  }
  if (result != VK_SUCCESS) return failure("Vulkan could not be started", result);
  GLOAM_TRY(load_functions(loader));
  return options.validate ? make_messenger() : Status();
}

Status Instance::make_messenger() {
  const VkDebugUtilsMessengerCreateInfoEXT info = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT,
      .pfnUserCallback = &Instance::on_message,
      .pUserData = this};
  const VkResult result =
      null_on_failure(functions_.vkCreateDebugUtilsMessengerEXT(instance_, &info, nullptr, &messenger_), messenger_);
  if (result != VK_SUCCESS) return failure("Validation messages could not be subscribed to", result);
  return {};
}

VkBool32 Instance::on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  // The loader reports software drivers and unusual search paths as general messages, which are unrelated to gloam's
  // calls.
  const bool from_loader = data->pMessageIdName != nullptr && std::strcmp(data->pMessageIdName, "Loader Message") == 0;
  if (from_loader || (types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT) == 0) return VK_FALSE;
  auto* self = static_cast<Instance*>(user);
  self->messages_.fetch_add(1);
  std::string line = std::string("Vulkan: ") + data->pMessage;
  std::replace(line.begin(), line.end(), '\n', ' ');
  const bool is_error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
  self->log_.write_from("validation", is_error ? LogLevel::error : LogLevel::warning, line);
  return VK_FALSE;
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) functions_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  if (owned_ && instance_ != VK_NULL_HANDLE && functions_.vkDestroyInstance != nullptr)
    functions_.vkDestroyInstance(instance_, nullptr);
}

}  // namespace gloam::gpu::vulkan
