// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/binding/resource_sets.h"

#include <string>

#include "engine/gpu/vulkan/binding/descriptor_pool.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr std::uint32_t kSetsPerPool = 64;
constexpr std::uint32_t kSpareDescriptorsPerKind = 256;

}  // namespace

ResourceSets::~ResourceSets() {
  for (VkDescriptorPool pool : pools_) context_.vk.vkDestroyDescriptorPool(context_.device, pool, context_.allocation);
}

Result<ResourceSetHandle> ResourceSets::create(const Pipeline& like, std::uint32_t set,
                                               std::span<const Binding> bindings) {
  GLOAM_ASSERT(set >= 1, "set 0 is bound directly, not prepared");
  GLOAM_ASSERT(set < like.layout->sets.size(), "pipeline \"" + like.name + "\" has no set " + std::to_string(set));
  const std::lock_guard lock(mutex_);
  const Result<ResourceSet> made = allocate(like.layout->sets[set], like.shader.of_set(set));
  if (!made) return made.error();
  const auto writes = writer_.build(like, set, bindings, made->set, DescriptorWriter::Layouts::read_only);
  if (!writes) {
    free(*made);
    return writes.error();
  }
  context_.vk.vkUpdateDescriptorSets(context_.device, static_cast<std::uint32_t>(writes->size()), writes->data(), 0,
                                     nullptr);
  context_.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, made->set, like.name + " set " + std::to_string(set));
  return table_.insert(*made);
}

Result<ResourceSets::ResourceSet> ResourceSets::allocate(VkDescriptorSetLayout layout,
                                                         std::span<const ReflectedBinding> bindings) {
  const auto try_pool = [&](VkDescriptorPool pool, ResourceSet& set) {
    const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = pool,
                                              .descriptorSetCount = 1,
                                              .pSetLayouts = &layout};
    set.pool = pool;
    return context_.vk.vkAllocateDescriptorSets(context_.device, &info, &set.set);
  };
  ResourceSet set;
  for (auto pool = pools_.rbegin(); pool != pools_.rend(); ++pool) {
    if (try_pool(*pool, set) == VK_SUCCESS) return set;
  }
  VkResult result = add_pool(bindings);
  if (result == VK_SUCCESS) result = try_pool(pools_.back(), set);
  if (result != VK_SUCCESS) return failure("A descriptor set could not be made", result);
  return set;
}

VkResult ResourceSets::add_pool(std::span<const ReflectedBinding> bindings) {
  DescriptorCounts counts = count_descriptors(bindings);
  for (std::uint32_t& count : counts) count += kSpareDescriptorsPerKind;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  const VkResult result =
      create_descriptor_pool(context_, VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT, kSetsPerPool, counts, pool);
  if (result != VK_SUCCESS) return result;
  context_.set_name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "resource sets");
  pools_.push_back(pool);
  return VK_SUCCESS;
}

void ResourceSets::free(const ResourceSet& set) {
  context_.vk.vkFreeDescriptorSets(context_.device, set.pool, 1, &set.set);
}

void ResourceSets::destroy(ResourceSetHandle handle) {
  graveyard_.bury([this, set = table_.remove(handle)] {
    const std::lock_guard lock(mutex_);
    free(set);
  });
}

}  // namespace gloam::gpu::vulkan
