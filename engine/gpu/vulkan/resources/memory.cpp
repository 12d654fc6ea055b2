// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/memory.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr VkMemoryPropertyFlags kMappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

VkMemoryPropertyFlags required_flags(MemoryKind kind) { return kind == MemoryKind::device ? 0 : kMappable; }

/// How well a memory type fits; larger is better. types_by_fitness excludes types with special meanings (protected,
/// lazily allocated, coherent or uncached on the device).
int fitness(VkMemoryPropertyFlags flags, MemoryKind kind) {
  const bool local = (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
  const bool visible = (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
  const bool cached = (flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT) != 0;
  switch (kind) {
    case MemoryKind::device:
      return (local ? 2 : 0) + (visible ? 0 : 1);
    case MemoryKind::upload:
      return (cached ? 0 : 2) + (local ? 0 : 1);
    case MemoryKind::readback:
      return (cached ? 2 : 0) + (local ? 0 : 1);
  }
  return 0;
}

/// The properties that a host's allocator should prefer; in the order of fitness().
VkMemoryPropertyFlags preferred_flags(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::device:
      return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    case MemoryKind::upload:
      return 0;
    case MemoryKind::readback:
      return VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  }
  return 0;
}

}  // namespace

MemoryAllocator::MemoryAllocator(Context& context, const MemoryOptions& options, HostMemoryAllocator* host)
    : context_(context), options_(options), host_(host) {
  GLOAM_ASSERT(options.block_bytes >= MemoryOptions::kLeastBlockBytes,
               "MemoryOptions::block_bytes is at least MemoryOptions::kLeastBlockBytes");
}

MemoryAllocator::~MemoryAllocator() {
  while (!blocks_.empty()) release(blocks_.begin());
}

MemoryAllocator::Pool MemoryAllocator::pool_of(const MemoryRequest& request) {
  switch (request.kind) {
    case MemoryKind::upload:
      return Pool::upload;
    case MemoryKind::readback:
      return Pool::readback;
    case MemoryKind::device:
      break;
  }
  if (request.block) return Pool::blocks;
  return request.image ? Pool::images : Pool::buffers;
}

std::vector<std::uint32_t> MemoryAllocator::types_by_fitness(std::uint32_t allowed, MemoryKind kind) const {
  constexpr VkMemoryPropertyFlags kSpecial =
      VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
      VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;
  const VkPhysicalDeviceMemoryProperties& memory = context_.physical.memory;
  const VkMemoryPropertyFlags required = required_flags(kind);
  std::vector<std::uint32_t> types;
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
    const bool usable = (allowed & (1u << i)) != 0 && (flags & required) == required && (flags & kSpecial) == 0;
    if (usable) types.push_back(i);
  }
  std::stable_sort(types.begin(), types.end(), [&](std::uint32_t a, std::uint32_t b) {
    return fitness(memory.memoryTypes[a].propertyFlags, kind) > fitness(memory.memoryTypes[b].propertyFlags, kind);
  });
  return types;
}

Result<AllocationOwner> MemoryAllocator::allocate(const MemoryRequest& request) {
  const std::lock_guard lock(mutex_);
  const auto no_memory = [&] {
    return "No memory for \"" + std::string(request.name) + "\" of module \"" + std::string(request.module) + "\" (" +
           std::to_string(request.requirements.size) + " bytes)";
  };
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  if (host_ != nullptr) {
    if (auto allocation = allocate_from_host(request, result)) return std::move(*allocation);
  } else {
    for (const std::uint32_t type : types_by_fitness(request.requirements.memoryTypeBits, request.kind)) {
      if (auto allocation = allocate_in(type, request, result)) return std::move(*allocation);
    }
  }
  if (options_.budget_bytes > 0 && reserved_ + request.requirements.size > options_.budget_bytes) {
    return Error{ErrorKind::failed, no_memory() + ": MemoryOptions::budget_bytes is " +
                                        std::to_string(options_.budget_bytes) + ", of which " +
                                        std::to_string(reserved_) + " are reserved"};
  }
  return failure(no_memory(), result);
}

std::optional<AllocationOwner> MemoryAllocator::allocate_from_host(const MemoryRequest& request, VkResult& result) {
  const std::vector<std::uint32_t> types = types_by_fitness(request.requirements.memoryTypeBits, request.kind);
  const std::uint64_t size = request.requirements.size;
  if (types.empty() || !make_room(size)) return std::nullopt;
  HostMemoryRequest asked = {.requirements = request.requirements,
                             .required = required_flags(request.kind),
                             .preferred = preferred_flags(request.kind),
                             .mapped = request.kind != MemoryKind::device,
                             .image = request.image,
                             .block = request.block,
                             .module = request.module,
                             .name = request.name};
  asked.requirements.memoryTypeBits = 0;
  for (const std::uint32_t type : types) asked.requirements.memoryTypeBits |= 1u << type;
  if (request.block)
    asked.requirements.alignment =
        std::max(asked.requirements.alignment, context_.physical.limits.bufferImageGranularity);
  HostMemory given;
  result = host_->allocate(asked, given);
  if (result != VK_SUCCESS) return std::nullopt;
  GLOAM_ASSERT(given.memory != VK_NULL_HANDLE &&
                   given.offset % std::max<VkDeviceSize>(asked.requirements.alignment, 1) == 0 &&
                   (!asked.mapped || given.mapped != nullptr),
               "HostMemoryAllocator::allocate gives aligned memory, mapped if the request says so");
  blocks_.push_back(
      {pool_of(request), 0, VK_NULL_HANDLE, static_cast<std::byte*>(given.mapped), RangeAllocator(size), true, given});
  reserved_ += size;
  const auto block = std::prev(blocks_.end());
  return take(block, block->ranges.allocate(size).value(), request);
}

std::optional<AllocationOwner> MemoryAllocator::allocate_in(std::uint32_t type, const MemoryRequest& request,
                                                            VkResult& result) {
  const std::uint64_t size = request.requirements.size;
  const std::uint64_t alignment = std::max<std::uint64_t>(request.requirements.alignment, 1);
  const Pool pool = pool_of(request);
  const bool dedicated = request.block || size > options_.block_bytes / 2;
  if (!dedicated) {
    for (auto block = blocks_.begin(); block != blocks_.end(); ++block) {
      if (block->type != type || block->pool != pool || block->dedicated) continue;
      if (auto offset = block->ranges.allocate(size, alignment)) return take(block, *offset, request);
    }
  }
  result = add_block(type, pool, dedicated ? size : next_block_bytes(type, pool, size), dedicated);
  if (result != VK_SUCCESS && !dedicated) result = add_block(type, pool, size, true);  // no room for a whole block
  if (result != VK_SUCCESS) return std::nullopt;
  const auto block = std::prev(blocks_.end());
  return take(block, block->ranges.allocate(size, alignment).value(), request);
}

std::uint64_t MemoryAllocator::next_block_bytes(std::uint32_t type, Pool pool, std::uint64_t size) const {
  std::uint64_t there = 0;
  for (const Block& block : blocks_)
    if (block.type == type && block.pool == pool && !block.dedicated) there += block.ranges.capacity();
  const std::uint64_t least = std::max(MemoryOptions::kLeastBlockBytes, std::bit_ceil(2 * size));
  return std::min(options_.block_bytes, std::max(least, std::bit_ceil(there)));
}

bool MemoryAllocator::make_room(std::uint64_t bytes) {
  if (options_.budget_bytes == 0 || reserved_ + bytes <= options_.budget_bytes) return true;
  release_empty_blocks();
  return reserved_ + bytes <= options_.budget_bytes;
}

VkResult MemoryAllocator::add_block(std::uint32_t type, Pool pool, std::uint64_t bytes, bool dedicated) {
  if (bytes > context_.physical.max_allocation_size || !make_room(bytes)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkMemoryAllocateInfo info = {
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = bytes, .memoryTypeIndex = type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkResult result = context_.vk.vkAllocateMemory(context_.device, &info, context_.allocation, &memory);
  if (result != VK_SUCCESS) return result;
  void* mapped = nullptr;
  if (pool == Pool::upload || pool == Pool::readback) {
    result = context_.vk.vkMapMemory(context_.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (result != VK_SUCCESS) {
      context_.vk.vkFreeMemory(context_.device, memory, context_.allocation);
      return result;
    }
  }
  blocks_.push_back({pool, type, memory, static_cast<std::byte*>(mapped), RangeAllocator(bytes), dedicated, {}});
  reserved_ += bytes;
  context_.set_name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, dedicated ? "memory of one object" : "memory block");
  return VK_SUCCESS;
}

AllocationOwner MemoryAllocator::take(Blocks::iterator block, std::uint64_t offset, const MemoryRequest& request) {
  const bool of_host = block->memory == VK_NULL_HANDLE;
  auto* allocation = new Allocation{of_host ? block->host.memory : block->memory,
                                    of_host ? block->host.offset : offset,
                                    request.requirements.size,
                                    block->mapped == nullptr ? nullptr : block->mapped + offset,
                                    {{std::string(request.module), request.requirements.size}}};
  add_shares(*allocation);
  return {allocation, [this, block](const Allocation* a) {
            give_back(block, *a);
            delete a;
          }};
}

void MemoryAllocator::add_shares(const Allocation& allocation) {
  for (const ModuleMemory& share : allocation.shares) module_bytes_[share.module] += share.bytes;
}

void MemoryAllocator::remove_shares(const Allocation& allocation) {
  for (const ModuleMemory& share : allocation.shares) {
    const auto bytes = module_bytes_.find(share.module);
    bytes->second -= share.bytes;
    if (bytes->second == 0) module_bytes_.erase(bytes);
  }
}

void MemoryAllocator::account(const AllocationOwner& allocation, std::span<const ModuleMemory> shares,
                              std::string_view module) {
  const std::lock_guard lock(mutex_);
  remove_shares(*allocation);
  allocation->shares.clear();
  std::uint64_t unaccounted = allocation->size;
  for (const ModuleMemory& share : shares) {
    GLOAM_ASSERT(share.bytes <= unaccounted, "no more bytes are accounted than a memory block has");
    unaccounted -= share.bytes;
    if (share.bytes > 0) allocation->shares.push_back(share);
  }
  if (unaccounted > 0) allocation->shares.push_back({std::string(module), unaccounted});
  add_shares(*allocation);
}

void MemoryAllocator::give_back(Blocks::iterator block, const Allocation& allocation) {
  const std::lock_guard lock(mutex_);
  remove_shares(allocation);
  block->ranges.free(block->memory == VK_NULL_HANDLE ? 0 : allocation.offset);
  if (!block->ranges.empty()) return;
  // Keeps one empty block per memory type and pool, so that an object that is created and destroyed every frame does
  // not allocate memory from the driver each time.
  const bool another_empty = std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& b) {
    return &b != &*block && b.type == block->type && b.pool == block->pool && !b.dedicated && b.ranges.empty();
  });
  if (block->dedicated || another_empty) release(block);
}

void MemoryAllocator::release(Blocks::iterator block) {
  reserved_ -= block->ranges.capacity();
  if (block->memory == VK_NULL_HANDLE) {
    host_->free(block->host);
  } else {
    context_.vk.vkFreeMemory(context_.device, block->memory, context_.allocation);
  }
  blocks_.erase(block);
}

void MemoryAllocator::release_empty_blocks() {
  for (auto block = blocks_.begin(); block != blocks_.end();) {
    const auto next = std::next(block);
    if (block->ranges.empty()) release(block);
    block = next;
  }
}

void MemoryAllocator::free_empty_blocks() {
  const std::lock_guard lock(mutex_);
  release_empty_blocks();
}

MemoryTotals MemoryAllocator::totals() const {
  const std::lock_guard lock(mutex_);
  MemoryTotals totals = {
      .reserved = reserved_, .blocks = static_cast<std::uint32_t>(blocks_.size()), .budget = options_.budget_bytes};
  for (const auto& [module, bytes] : module_bytes_) totals.used += bytes;
  return totals;
}

std::vector<ModuleMemory> MemoryAllocator::usage() const {
  const std::lock_guard lock(mutex_);
  std::vector<ModuleMemory> usage;
  for (const auto& [module, bytes] : module_bytes_) usage.push_back({module, bytes});
  return usage;
}

}  // namespace gloam::gpu::vulkan
