// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/buffers.h"

#include <string>

#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"
#include "engine/gpu/vulkan/resources/memory_blocks.h"

namespace gloam::gpu::vulkan {
namespace {

std::string cannot_make(const BufferDesc& desc) {
  return "Buffer \"" + desc.name + "\" of module \"" + desc.module + "\" could not be made";
}

VkBufferCreateInfo create_info(const BufferDesc& desc) {
  return {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
          .size = desc.size,
          .usage = to_vulkan(desc.usage),
          .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
}

}  // namespace

Buffers::~Buffers() {
  for (const Buffer& b : table_.remove_all())
    if (b.memory) context_.vk.vkDestroyBuffer(context_.device, b.buffer, context_.allocation);
}

Status Buffers::check(const BufferDesc& desc) const {
  GLOAM_ASSERT(desc.size > 0, "a buffer holds at least one byte");
  GLOAM_ASSERT(desc.usage != BufferUsage::none, "a buffer must be used for something");
  if (desc.size <= context_.physical.max_buffer_size) return {};
  return Error{ErrorKind::failed, cannot_make(desc) + ": it has " + std::to_string(desc.size) +
                                      " bytes, and the device allows " +
                                      std::to_string(context_.physical.max_buffer_size)};
}

Result<Buffer> Buffers::make(const BufferDesc& desc) const {
  GLOAM_TRY(check(desc));
  Buffer buffer;
  buffer.desc = desc;
  const VkBufferCreateInfo info = create_info(desc);
  const VkResult result = context_.vk.vkCreateBuffer(context_.device, &info, context_.allocation, &buffer.buffer);
  if (result != VK_SUCCESS) return failure(cannot_make(desc), result);
  context_.set_name(VK_OBJECT_TYPE_BUFFER, buffer.buffer, desc.name);
  return buffer;
}

Result<BufferHandle> Buffers::bind(Buffer buffer, const AllocationOwner& memory, std::uint64_t offset) {
  buffer.memory = memory;
  const VkResult result =
      context_.vk.vkBindBufferMemory(context_.device, buffer.buffer, memory->memory, memory->offset + offset);
  if (result == VK_SUCCESS) return table_.insert(std::move(buffer));
  context_.vk.vkDestroyBuffer(context_.device, buffer.buffer, context_.allocation);
  return failure(cannot_make(buffer.desc), result);
}

Result<BufferHandle> Buffers::create(const BufferDesc& desc) {
  Result<Buffer> buffer = make(desc);
  if (!buffer) return buffer.error();
  MemoryRequest request = {.kind = desc.memory, .module = desc.module, .name = desc.name};
  context_.vk.vkGetBufferMemoryRequirements(context_.device, buffer->buffer, &request.requirements);
  const Result<AllocationOwner> memory = memory_.allocate(request);
  if (memory) return bind(std::move(*buffer), *memory, 0);
  context_.vk.vkDestroyBuffer(context_.device, buffer->buffer, context_.allocation);
  return memory.error();
}

Result<BufferHandle> Buffers::create_in(const BufferDesc& desc, const AllocationOwner& block, std::uint64_t offset) {
  GLOAM_ASSERT(desc.memory == MemoryKind::device, "a buffer in a memory block is in device memory");
  const Result<MemoryNeeds> needed = needs(desc);
  if (!needed) return needed.error();
  check_place(*block, *needed, offset, desc.name);
  Result<Buffer> buffer = make(desc);
  if (!buffer) return buffer.error();
  return bind(std::move(*buffer), block, offset);
}

Result<MemoryNeeds> Buffers::needs(const BufferDesc& desc) const {
  GLOAM_TRY(check(desc));
  const VkBufferCreateInfo info = create_info(desc);
  const VkDeviceBufferMemoryRequirements query = {.sType = VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS,
                                                  .pCreateInfo = &info};
  VkMemoryRequirements2 requirements = {.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  context_.vk.vkGetDeviceBufferMemoryRequirements(context_.device, &query, &requirements);
  return needs_in_block(context_, requirements.memoryRequirements);
}

BufferHandle Buffers::adopt(const BufferDesc& desc, VkBuffer buffer) {
  GLOAM_ASSERT(desc.size > 0 && desc.usage != BufferUsage::none,
               "the description of a host's buffer states its size and usage");
  GLOAM_ASSERT(desc.memory == MemoryKind::device, "gloam does not map a host's buffer: its memory kind is device");
  Buffer adopted;
  adopted.desc = desc;
  adopted.buffer = buffer;
  return table_.insert(std::move(adopted));
}

void Buffers::destroy(BufferHandle handle) {
  Buffer buffer = table_.remove(handle);
  if (!buffer.memory) return;
  graveyard_.bury([this, vk_buffer = buffer.buffer, memory = std::move(buffer.memory)] {
    context_.vk.vkDestroyBuffer(context_.device, vk_buffer, context_.allocation);
  });
}

std::span<std::byte> Buffers::mapped(BufferHandle handle) const {
  const Buffer& buffer = get(handle);
  GLOAM_ASSERT(buffer.memory && buffer.memory->mapped != nullptr, "only upload and readback buffers are mapped");
  return {buffer.memory->mapped, static_cast<std::size_t>(buffer.desc.size)};
}

}  // namespace gloam::gpu::vulkan
