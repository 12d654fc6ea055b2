// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/context.h"
#include "engine/gpu/vulkan/graveyard.h"
#include "engine/gpu/vulkan/memory.h"

namespace gloam::gpu::vulkan {

struct Buffer {
  BufferDesc desc;
  VkBuffer buffer = VK_NULL_HANDLE;
  AllocationOwner memory;
};

/// Creates, stores and destroys buffers. Thread-safe.
class Buffers {
 public:
  Buffers(Context& context, MemoryAllocator& memory, Graveyard& graveyard)
      : context_(context), memory_(memory), graveyard_(graveyard) {}
  ~Buffers();

  [[nodiscard]] Result<BufferHandle> create(const BufferDesc& desc);
  void destroy(BufferHandle handle);
  [[nodiscard]] const Buffer& get(BufferHandle handle) const { return table_.get(handle); }
  [[nodiscard]] std::span<std::byte> mapped(BufferHandle handle) const;

 private:
  Context& context_;
  MemoryAllocator& memory_;
  Graveyard& graveyard_;
  HandleTable<Buffer, BufferHandle> table_;
};

}  // namespace gloam::gpu::vulkan
