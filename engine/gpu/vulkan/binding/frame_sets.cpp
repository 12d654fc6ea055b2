// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/binding/frame_sets.h"

#include <algorithm>

#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr std::uint32_t kDescriptorsPerKind = 1024;

}  // namespace

bool FrameSets::Pool::has_room_for(const DescriptorCounts& more) const {
  if (sets == most_sets) return false;
  for (std::size_t i = 0; i < more.size(); ++i) {
    if (more[i] > most[i] - used[i]) return false;
  }
  return true;
}

FrameSets::~FrameSets() {
  for (const Slot& slot : slots_) {
    for (const Pool& pool : slot.pools) {
      context_.vk.vkDestroyDescriptorPool(context_.device, pool.pool, context_.allocation);
    }
  }
}

void FrameSets::begin(std::uint64_t frame) {
  frame_slot_ = frame % slots_.size();
  Slot& slot = slots_[frame_slot_];
  for (Pool& pool : slot.pools) {
    if (pool.sets == 0) continue;
    static_cast<void>(context_.vk.vkResetDescriptorPool(context_.device, pool.pool, 0));  // Vulkan: it cannot fail
    pool.sets = 0;
    pool.used = {};
  }
  slot.current = 0;
}

VkResult FrameSets::add_pool(Slot& slot, const DescriptorCounts& least) {
  Pool pool;
  pool.most_sets = kSetsPerPool;
  for (std::size_t i = 0; i < least.size(); ++i) pool.most[i] = std::max(kDescriptorsPerKind, least[i]);
  const VkResult result = create_descriptor_pool(context_, 0, pool.most_sets, pool.most, pool.pool);
  if (result != VK_SUCCESS) return result;
  context_.set_name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool.pool, "frame sets");
  slot.pools.push_back(pool);
  return VK_SUCCESS;
}

Result<VkDescriptorSet> FrameSets::allocate(VkDescriptorSetLayout layout, std::span<const ReflectedBinding> bindings) {
  const DescriptorCounts counts = count_descriptors(bindings);
  Slot& slot = slots_[frame_slot_];
  // The pool is counted here, because a driver need not refuse more than the pool was made for. A driver may refuse
  // less, because its pool is fragmented: then a new pool is tried once.
  while (slot.current < slot.pools.size() && !slot.pools[slot.current].has_room_for(counts)) ++slot.current;
  VkResult result = VK_ERROR_OUT_OF_POOL_MEMORY;
  VkDescriptorSet set = VK_NULL_HANDLE;
  for (int attempt = 0; attempt < 2 && result != VK_SUCCESS; ++attempt) {
    if (attempt > 0 || slot.current == slot.pools.size()) {
      result = add_pool(slot, counts);
      if (result != VK_SUCCESS) break;
      slot.current = slot.pools.size() - 1;
    }
    Pool& pool = slot.pools[slot.current];
    const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = pool.pool,
                                              .descriptorSetCount = 1,
                                              .pSetLayouts = &layout};
    result = context_.vk.vkAllocateDescriptorSets(context_.device, &info, &set);
    if (result != VK_SUCCESS) continue;
    ++pool.sets;
    for (std::size_t i = 0; i < counts.size(); ++i) pool.used[i] += counts[i];
  }
  if (result != VK_SUCCESS) return failure("A descriptor set could not be made", result);
  return set;
}

std::size_t FrameSets::pool_count() const {
  std::size_t count = 0;
  for (const Slot& slot : slots_) count += slot.pools.size();
  return count;
}

}  // namespace gloam::gpu::vulkan
