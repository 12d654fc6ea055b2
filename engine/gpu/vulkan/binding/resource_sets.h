// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/binding/descriptor_writer.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// Prepared descriptor sets. A descriptor pool is added when the existing ones are full. Thread-safe.
class ResourceSets {
 public:
  ResourceSets(Context& context, Graveyard& graveyard, const DescriptorWriter& writer)
      : context_(context), graveyard_(graveyard), writer_(writer) {}
  ~ResourceSets();

  [[nodiscard]] Result<ResourceSetHandle> create(const Pipeline& like, std::uint32_t set,
                                                 std::span<const Binding> bindings);
  void destroy(ResourceSetHandle handle);
  [[nodiscard]] VkDescriptorSet get(ResourceSetHandle handle) const { return table_.get(handle).set; }

 private:
  struct ResourceSet {
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
  };
  Result<ResourceSet> allocate(VkDescriptorSetLayout layout, std::span<const ReflectedBinding> bindings);
  VkResult add_pool(std::span<const ReflectedBinding> bindings);
  void free(const ResourceSet& set);

  Context& context_;
  Graveyard& graveyard_;
  std::mutex mutex_;
  DescriptorWriter writer_;
  std::vector<VkDescriptorPool> pools_;
  HandleTable<ResourceSet, ResourceSetHandle> table_;
};

}  // namespace gloam::gpu::vulkan
