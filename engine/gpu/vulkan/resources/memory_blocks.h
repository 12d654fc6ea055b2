// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/resources/memory.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// The memory blocks into which callers place images and buffers. Thread-safe.
class MemoryBlocks {
 public:
  MemoryBlocks(MemoryAllocator& memory, Graveyard& graveyard) : memory_(memory), graveyard_(graveyard) {}

  [[nodiscard]] Result<MemoryHandle> create(const MemoryDesc& desc);
  /// The memory is freed when all frames in flight have finished and no object lies in it any more.
  void destroy(MemoryHandle handle);
  void account(MemoryHandle handle, std::span<const ModuleMemory> shares);
  [[nodiscard]] const AllocationOwner& get(MemoryHandle handle) const { return table_.get(handle).memory; }

 private:
  struct Block {
    std::string module;
    AllocationOwner memory;
  };

  MemoryAllocator& memory_;
  Graveyard& graveyard_;
  HandleTable<Block, MemoryHandle> table_;
};

/// The needs of an object that may lie beside images and buffers: sizes and alignments are multiples of
/// bufferImageGranularity.
[[nodiscard]] MemoryNeeds needs_in_block(const Context& context, const VkMemoryRequirements& requirements);

/// Asserts that an object with these needs fits the block at this offset.
void check_place(const Allocation& block, const MemoryNeeds& needs, std::uint64_t offset, const std::string& name);

}  // namespace gloam::gpu::vulkan
