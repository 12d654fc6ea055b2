// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/buffers.h"

#include <string>

#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {

Buffers::~Buffers() {
  for (const Buffer& b : table_.remove_all()) context_.vk.vkDestroyBuffer(context_.device, b.buffer, nullptr);
}

Result<BufferHandle> Buffers::create(const BufferDesc& desc) {
  GLOAM_ASSERT(desc.size > 0, "a buffer holds at least one byte");
  GLOAM_ASSERT(desc.usage != BufferUsage::none, "a buffer must be used for something");
  const std::string what = "Buffer \"" + desc.name + "\" of module \"" + desc.module + "\" could not be made";
  if (desc.size > context_.physical.max_buffer_size) {
    return Error{ErrorKind::failed, what + ": it has " + std::to_string(desc.size) + " bytes, and the device allows " +
                                        std::to_string(context_.physical.max_buffer_size)};
  }
  Buffer buffer;
  buffer.desc = desc;
  const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                   .size = desc.size,
                                   .usage = to_vulkan(desc.usage),
                                   .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
  VkResult result = context_.vk.vkCreateBuffer(context_.device, &info, nullptr, &buffer.buffer);
  if (result != VK_SUCCESS) return failure(what, result);
  context_.set_name(VK_OBJECT_TYPE_BUFFER, buffer.buffer, desc.name);

  MemoryRequest request = {.kind = desc.memory, .module = desc.module, .name = desc.name};
  context_.vk.vkGetBufferMemoryRequirements(context_.device, buffer.buffer, &request.requirements);
  Result<AllocationOwner> memory = memory_.allocate(request);
  if (memory) {
    buffer.memory = *memory;
    result =
        context_.vk.vkBindBufferMemory(context_.device, buffer.buffer, buffer.memory->memory, buffer.memory->offset);
    if (result == VK_SUCCESS) return table_.insert(std::move(buffer));
  }
  context_.vk.vkDestroyBuffer(context_.device, buffer.buffer, nullptr);
  return memory ? failure(what, result) : memory.error();
}

void Buffers::destroy(BufferHandle handle) {
  Buffer buffer = table_.remove(handle);
  graveyard_.bury([this, vk_buffer = buffer.buffer, memory = std::move(buffer.memory)] {
    context_.vk.vkDestroyBuffer(context_.device, vk_buffer, nullptr);
  });
}

std::span<std::byte> Buffers::mapped(BufferHandle handle) const {
  const Buffer& buffer = get(handle);
  GLOAM_ASSERT(buffer.memory->mapped != nullptr, "only upload and readback buffers are mapped");
  return {buffer.memory->mapped, static_cast<std::size_t>(buffer.desc.size)};
}

}  // namespace gloam::gpu::vulkan
