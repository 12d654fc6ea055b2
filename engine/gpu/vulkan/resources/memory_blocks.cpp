// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/memory_blocks.h"

#include <algorithm>
#include <utility>

#include "engine/core/assert.h"

namespace gloam::gpu::vulkan {

Result<MemoryHandle> MemoryBlocks::create(const MemoryDesc& desc) {
  GLOAM_ASSERT(desc.size > 0, "a memory block holds at least one byte");
  const MemoryRequest request = {.requirements = {.size = desc.size, .alignment = 1, .memoryTypeBits = desc.types},
                                 .block = true,
                                 .module = desc.module,
                                 .name = desc.name};
  Result<AllocationOwner> memory = memory_.allocate(request);
  if (!memory) return memory.error();
  return table_.insert({desc.module, std::move(*memory)});
}

void MemoryBlocks::destroy(MemoryHandle handle) {
  graveyard_.bury([memory = table_.remove(handle).memory] {});
}

void MemoryBlocks::account(MemoryHandle handle, std::span<const ModuleMemory> shares) {
  const Block& block = table_.get(handle);
  memory_.account(block.memory, shares, block.module);
}

MemoryNeeds needs_in_block(const Context& context, const VkMemoryRequirements& requirements) {
  const std::uint64_t unit = std::max<std::uint64_t>(context.physical.limits.bufferImageGranularity, 1);
  return {.size = (requirements.size + unit - 1) / unit * unit,
          .alignment = std::max<std::uint64_t>(requirements.alignment, unit),
          .types = requirements.memoryTypeBits};
}

void check_place(const Allocation& block, const MemoryNeeds& needs, std::uint64_t offset, const std::string& name) {
  GLOAM_ASSERT(offset % needs.alignment == 0 && offset <= block.size && needs.size <= block.size - offset,
               "\"" + name + "\" lies inside its memory block, at a multiple of its alignment");
}

}  // namespace gloam::gpu::vulkan
