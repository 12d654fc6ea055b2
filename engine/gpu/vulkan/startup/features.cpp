// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/features.h"

#include <array>
#include <string_view>

namespace gloam::gpu::vulkan {
namespace {

using Core = VkPhysicalDeviceFeatures;
using V12 = VkPhysicalDeviceVulkan12Features;
using V13 = VkPhysicalDeviceVulkan13Features;

/// `of_shaders`: gloam's own shaders need the feature, as a test reads from their SPIR-V. Otherwise `needed_by` is a
/// Vulkan function of functions.h that needs it.
template <class Part>
struct Feature {
  VkBool32 Part::*flag;
  std::string_view name;
  bool of_shaders;
  std::string_view needed_by;
};

constexpr std::array kRequiredCore = {
    Feature<Core>{&Core::shaderStorageImageExtendedFormats, "shaderStorageImageExtendedFormats", true,
                  "capability StorageImageExtendedFormats"},
};
constexpr std::array kRequired12 = {
    Feature<V12>{&V12::timelineSemaphore, "timelineSemaphore", false, "vkWaitSemaphores"},
    Feature<V12>{&V12::scalarBlockLayout, "scalarBlockLayout", true, "member offsets of blocks"},
};
constexpr std::array kRequired13 = {
    Feature<V13>{&V13::dynamicRendering, "dynamicRendering", false, "vkCmdBeginRendering"},
    Feature<V13>{&V13::synchronization2, "synchronization2", false, "vkQueueSubmit2"},
    Feature<V13>{&V13::maintenance4, "maintenance4", true, "execution mode LocalSizeId"},
};
// Optional: what the interface of this layer offers beyond what gloam's own passes use.
constexpr std::array kUsefulCore = {
    &Core::samplerAnisotropy,               // SamplerDesc::max_anisotropy
    &Core::multiDrawIndirect,               // CommandList::draw_indexed_indirect; draws one by one without it
    &Core::drawIndirectFirstInstance,       // indirect draws whose first instance is not 0
    &Core::independentBlend,                // GraphicsPipelineDesc::blend with integer targets among others
    &Core::imageCubeArray,                  // arrays of cubes in shaders of other modules
    &Core::fragmentStoresAndAtomics,        // buffers and images written by fragment shaders of other modules
    &Core::vertexPipelineStoresAndAtomics,  // and by vertex shaders
};

template <class Part, std::size_t kCount>
void add_missing(std::string& list, const std::array<Feature<Part>, kCount>& required, const Part& part) {
  for (const Feature<Part>& feature : required) {
    if (part.*feature.flag == VK_TRUE) continue;
    list += list.empty() ? "" : ", ";
    list += feature.name;
  }
}

/// Casts a link of a chain to the structure that its sType names.
template <class Struct>
const Struct& as(const VkBaseInStructure* link) {
  return *reinterpret_cast<const Struct*>(link);
}

/// Enables the features that one link of a chain enables.
void add_link(Features& on, const VkBaseInStructure* link) {
  const auto add = [](VkBool32& flag, VkBool32 value) {
    flag = flag == VK_TRUE || value == VK_TRUE ? VK_TRUE : VK_FALSE;
  };
  switch (link->sType) {
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
      for (const auto& f : kRequired12) add(on.v12.*f.flag, as<V12>(link).*f.flag);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
      for (const auto& f : kRequired13) add(on.v13.*f.flag, as<V13>(link).*f.flag);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES:
      add(on.v12.timelineSemaphore, as<VkPhysicalDeviceTimelineSemaphoreFeatures>(link).timelineSemaphore);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
      add(on.v12.scalarBlockLayout, as<VkPhysicalDeviceScalarBlockLayoutFeatures>(link).scalarBlockLayout);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES:
      add(on.v13.dynamicRendering, as<VkPhysicalDeviceDynamicRenderingFeatures>(link).dynamicRendering);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
      add(on.v13.synchronization2, as<VkPhysicalDeviceSynchronization2Features>(link).synchronization2);
      break;
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
      add(on.v13.maintenance4, as<VkPhysicalDeviceMaintenance4Features>(link).maintenance4);
      break;
    default:
      break;
  }
}

}  // namespace

VkPhysicalDeviceFeatures2* Features::chain() {
  core.pNext = &v12;
  v12.pNext = &v13;
  return &core;
}

void require_features(Core& core, V12& v12, V13& v13) {
  for (const auto& f : kRequiredCore) core.*f.flag = VK_TRUE;
  for (const auto& f : kRequired12) v12.*f.flag = VK_TRUE;
  for (const auto& f : kRequired13) v13.*f.flag = VK_TRUE;
}

void add_useful_features(const Core& core_there, Core& core) {
  for (auto flag : kUsefulCore) {
    if (core_there.*flag == VK_TRUE) core.*flag = VK_TRUE;
  }
}

Features features_to_enable(const Features& supported) {
  Features on;
  require_features(on.core.features, on.v12, on.v13);
  add_useful_features(supported.core.features, on.core.features);
  return on;
}

std::vector<RequiredFeature> required_features() {
  std::vector<RequiredFeature> list;
  const auto add = [&](const auto& part) {
    for (const auto& f : part) list.push_back({f.name, f.of_shaders, f.needed_by});
  };
  add(kRequiredCore);
  add(kRequired12);
  add(kRequired13);
  return list;
}

std::string missing_features(const Features& features) {
  std::string list;
  add_missing(list, kRequiredCore, features.core.features);
  add_missing(list, kRequired12, features.v12);
  add_missing(list, kRequired13, features.v13);
  return list;
}

Features features_of_chain(const VkPhysicalDeviceFeatures2& chain) {
  Features on;
  on.core.features = chain.features;
  for (auto* link = static_cast<const VkBaseInStructure*>(chain.pNext); link != nullptr; link = link->pNext) {
    add_link(on, link);
  }
  return on;
}

}  // namespace gloam::gpu::vulkan
