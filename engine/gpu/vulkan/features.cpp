// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/features.h"

#include <array>
#include <string_view>

namespace gloam::gpu::vulkan {
namespace {

using Core = VkPhysicalDeviceFeatures;
using V12 = VkPhysicalDeviceVulkan12Features;
using V13 = VkPhysicalDeviceVulkan13Features;

template <class Part>
struct Feature {
  VkBool32 Part::*flag;
  std::string_view name;
};

constexpr std::array kRequiredCore = {
    Feature<Core>{&Core::fragmentStoresAndAtomics, "fragmentStoresAndAtomics"},
    Feature<Core>{&Core::drawIndirectFirstInstance, "drawIndirectFirstInstance"},
    Feature<Core>{&Core::multiDrawIndirect, "multiDrawIndirect"},
    Feature<Core>{&Core::independentBlend, "independentBlend"},
    Feature<Core>{&Core::imageCubeArray, "imageCubeArray"},
};
constexpr std::array kRequired12 = {
    Feature<V12>{&V12::timelineSemaphore, "timelineSemaphore"},
    Feature<V12>{&V12::scalarBlockLayout, "scalarBlockLayout"},
};
constexpr std::array kRequired13 = {
    Feature<V13>{&V13::dynamicRendering, "dynamicRendering"},
    Feature<V13>{&V13::synchronization2, "synchronization2"},
    Feature<V13>{&V13::maintenance4, "maintenance4"},
};
constexpr std::array kUsefulCore = {
    &Core::samplerAnisotropy,
    &Core::depthClamp,
    &Core::shaderStorageImageReadWithoutFormat,
    &Core::shaderStorageImageWriteWithoutFormat,
    &Core::shaderStorageImageExtendedFormats,
    &Core::vertexPipelineStoresAndAtomics,
};
constexpr std::array kUseful12 = {
    &V12::shaderOutputLayer,
    &V12::shaderSubgroupExtendedTypes,
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
      for (auto flag : kUseful12) add(on.v12.*flag, as<V12>(link).*flag);
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
    case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_EXTENDED_TYPES_FEATURES:
      add(on.v12.shaderSubgroupExtendedTypes,
          as<VkPhysicalDeviceShaderSubgroupExtendedTypesFeatures>(link).shaderSubgroupExtendedTypes);
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

void add_useful_features(const Core& core_there, const V12& v12_there, Core& core, V12& v12) {
  for (auto flag : kUsefulCore) {
    if (core_there.*flag == VK_TRUE) core.*flag = VK_TRUE;
  }
  for (auto flag : kUseful12) {
    if (v12_there.*flag == VK_TRUE) v12.*flag = VK_TRUE;
  }
}

Features features_to_enable(const Features& supported) {
  Features on;
  require_features(on.core.features, on.v12, on.v13);
  add_useful_features(supported.core.features, supported.v12, on.core.features, on.v12);
  return on;
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
