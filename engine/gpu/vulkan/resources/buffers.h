// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/resources/memory.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

struct Buffer {
  BufferDesc desc;
  VkBuffer buffer = VK_NULL_HANDLE;
  AllocationOwner memory;  ///< null: an adopted buffer, which is not destroyed here
};

/// Creates, stores and destroys buffers. Thread-safe.
class Buffers {
 public:
  Buffers(Context& context, MemoryAllocator& memory, Graveyard& graveyard)
      : context_(context), memory_(memory), graveyard_(graveyard) {}
  ~Buffers();

  [[nodiscard]] Result<BufferHandle> create(const BufferDesc& desc);
  /// Creates a buffer inside a memory block. offset: bytes from the begin of the block.
  [[nodiscard]] Result<BufferHandle> create_in(const BufferDesc& desc, const AllocationOwner& block,
                                               std::uint64_t offset);
  [[nodiscard]] Result<MemoryNeeds> needs(const BufferDesc& desc) const;
  /// Adds a buffer owned by a host. Destroying the handle does not destroy the buffer.
  [[nodiscard]] BufferHandle adopt(const BufferDesc& desc, VkBuffer buffer);
  void destroy(BufferHandle handle);
  [[nodiscard]] const Buffer& get(BufferHandle handle) const { return table_.get(handle); }
  [[nodiscard]] std::span<std::byte> mapped(BufferHandle handle) const;

 private:
  [[nodiscard]] Status check(const BufferDesc& desc) const;
  /// Makes the object without memory.
  [[nodiscard]] Result<Buffer> make(const BufferDesc& desc) const;
  /// Binds the memory and hands out the handle; destroys the object if that fails. offset: bytes from the begin of
  /// `memory`.
  [[nodiscard]] Result<BufferHandle> bind(Buffer buffer, const AllocationOwner& memory, std::uint64_t offset);

  Context& context_;
  MemoryAllocator& memory_;
  Graveyard& graveyard_;
  HandleTable<Buffer, BufferHandle> table_;
};

}  // namespace gloam::gpu::vulkan
