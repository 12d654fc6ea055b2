// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/range_allocator.h"
#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/startup/context.h"
#include "engine/gpu/vulkan_interop.h"

namespace gloam::gpu::vulkan {

/// A range of device memory. It returns to its allocator when its last owner is gone; aliased images share one.
struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
  std::byte* mapped = nullptr;  ///< address of the first byte; null for MemoryKind::device
  /// The modules that the bytes are accounted to. Only the allocator uses it.
  mutable std::vector<ModuleMemory> shares;
};
using AllocationOwner = std::shared_ptr<const Allocation>;

struct MemoryRequest {
  VkMemoryRequirements requirements = {};
  MemoryKind kind = MemoryKind::device;
  bool image = false;
  bool block = false;  ///< a memory block, which gets its own VkDeviceMemory
  std::string_view module;
  std::string_view name;  ///< for the error message
};

/// Allocates buffers and images from blocks (MemoryOptions), or has a host's allocator do it. Each block serves one
/// pool and one memory type. Images and buffers never share a block, so bufferImageGranularity does not matter.
/// Thread-safe.
class MemoryAllocator {
 public:
  /// host: null for blocks.
  MemoryAllocator(Context& context, const MemoryOptions& options, HostMemoryAllocator* host);
  ~MemoryAllocator();

  [[nodiscard]] Result<AllocationOwner> allocate(const MemoryRequest& request);
  /// Accounts the bytes of an allocation to these modules instead, the rest to `module`.
  void account(const AllocationOwner& allocation, std::span<const ModuleMemory> shares, std::string_view module);
  [[nodiscard]] std::vector<ModuleMemory> usage() const;
  [[nodiscard]] MemoryTotals totals() const;
  void free_empty_blocks();

 private:
  enum class Pool : std::uint8_t { buffers, images, upload, readback, blocks };
  struct Block {
    Pool pool;
    std::uint32_t type;
    VkDeviceMemory memory;
    std::byte* mapped;
    RangeAllocator ranges;
    bool dedicated;
    HostMemory host;  ///< what the host has given; `memory` is null then
  };
  using Blocks = std::list<Block>;

  static Pool pool_of(const MemoryRequest& request);
  [[nodiscard]] std::vector<std::uint32_t> types_by_fitness(std::uint32_t allowed, MemoryKind kind) const;
  std::optional<AllocationOwner> allocate_in(std::uint32_t type, const MemoryRequest& request, VkResult& result);
  /// Size of the next block for objects of `size` bytes, at most half of MemoryOptions::block_bytes.
  [[nodiscard]] std::uint64_t next_block_bytes(std::uint32_t type, Pool pool, std::uint64_t size) const;
  /// Whether the budget has room for these bytes, once empty blocks are given back.
  [[nodiscard]] bool make_room(std::uint64_t bytes);
  VkResult add_block(std::uint32_t type, Pool pool, std::uint64_t bytes, bool dedicated);
  std::optional<AllocationOwner> allocate_from_host(const MemoryRequest& request, VkResult& result);
  AllocationOwner take(Blocks::iterator block, std::uint64_t offset, const MemoryRequest& request);
  void give_back(Blocks::iterator block, const Allocation& allocation);
  void add_shares(const Allocation& allocation);
  void remove_shares(const Allocation& allocation);
  void release(Blocks::iterator block);
  void release_empty_blocks();

  Context& context_;
  mutable std::mutex mutex_;
  const MemoryOptions options_;
  HostMemoryAllocator* const host_;
  Blocks blocks_;
  std::uint64_t reserved_ = 0;  ///< bytes of all blocks
  std::map<std::string, std::uint64_t, std::less<>> module_bytes_;
};

}  // namespace gloam::gpu::vulkan
