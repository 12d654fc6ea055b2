// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/command_list.h"

#include <algorithm>
#include <string>

#include "engine/gpu/image_size.h"
#include "engine/gpu/vulkan/barriers.h"
#include "engine/gpu/vulkan/convert.h"

// Labels, barriers and copies. Rendering, drawing and dispatching are in command_list_work.cpp.
namespace gloam::gpu::vulkan {
namespace {

VkExtent3D mip_extent(const ImageDesc& desc, std::uint32_t mip) {
  return {std::max(desc.width >> mip, 1u), std::max(desc.height >> mip, 1u), std::max(desc.depth >> mip, 1u)};
}

VkBufferImageCopy packed_region(const ImageDesc& desc, std::uint64_t offset, std::uint32_t mip, std::uint32_t layer,
                                std::uint32_t layers) {
  GLOAM_ASSERT(mip < desc.mips && layer < desc.layers && layers <= desc.layers - layer,
               "a copy stays inside image \"" + desc.name + "\"");
  return {.bufferOffset = offset,
          .imageSubresource = {aspect_of(desc.format), mip, layer, layers},
          .imageExtent = mip_extent(desc, mip)};
}

void check_transfer_layout(const Image& image, const ImageRange& range, Access wanted) {
  image.access.visit(resolve(range, image.desc), [&](Access access) {
    GLOAM_ASSERT(access == wanted, "image \"" + image.desc.name + "\" must be in " + std::string(name_of(wanted)) +
                                       " for this copy, and its last barrier left it in " +
                                       std::string(name_of(access)) + text_of(range));
  });
}

ImageRange range_of(const ImagePart& part) { return {part.mip, 1, part.layer, 1}; }

}  // namespace

void VulkanCommandList::start(VkCommandBuffer commands) {
  commands_ = commands;
  pipeline_ = {};
  bound_.start();
  fault_.reset();
  has_begun_rendering_ = false;
  earlier_accesses_.clear();
}

void VulkanCommandList::forget_barriers() {
  for (auto change = earlier_accesses_.rbegin(); change != earlier_accesses_.rend(); ++change)
    if (images_.alive(change->first)) images_.get(change->first).access = change->second;
  earlier_accesses_.clear();
}

void VulkanCommandList::fail(const Error& error) {
  if (!fault_) fault_ = error;
}

void VulkanCommandList::check_range(BufferHandle buffer, std::uint64_t offset, std::uint64_t size) const {
  const BufferDesc& desc = buffers_.get(buffer).desc;
  GLOAM_ASSERT(offset <= desc.size && size <= desc.size - offset, "a range stays inside buffer \"" + desc.name + "\"");
}

void VulkanCommandList::begin_label(std::string_view name) {
  const auto begin = context_.instance_functions().vkCmdBeginDebugUtilsLabelEXT;
  if (begin == nullptr) return;
  const std::string text(name);
  const VkDebugUtilsLabelEXT label = {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = text.c_str()};
  begin(commands_, &label);
}

void VulkanCommandList::end_label() {
  if (const auto end = context_.instance_functions().vkCmdEndDebugUtilsLabelEXT) end(commands_);
}

void VulkanCommandList::write_timestamp(std::uint32_t index) { frames_.write_timestamp(index); }

void VulkanCommandList::barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) {
  if (buffers.empty() && images.empty()) return;
  bound_.check_outside("a barrier");
  buffer_barriers_.clear();
  image_barriers_.clear();
  for (const BufferBarrier& b : buffers) buffer_barriers_.push_back(to_vulkan(b, buffers_.get(b.buffer).buffer));
  for (const ImageBarrier& b : images) {
    Image& image = images_.get(b.image);
    image_barriers_.push_back(to_vulkan(b, image.image, aspect_of(image.desc.format)));
    earlier_accesses_.emplace_back(b.image, image.access);
    image.access.set(resolve(b.range, image.desc), b.after);
  }
  const VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                 .bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffer_barriers_.size()),
                                 .pBufferMemoryBarriers = buffer_barriers_.data(),
                                 .imageMemoryBarrierCount = static_cast<std::uint32_t>(image_barriers_.size()),
                                 .pImageMemoryBarriers = image_barriers_.data()};
  context_.vk.vkCmdPipelineBarrier2(commands_, &info);
}

void VulkanCommandList::copy_buffer(BufferHandle source, std::uint64_t source_offset, BufferHandle target,
                                    std::uint64_t target_offset, std::uint64_t size) {
  bound_.check_outside("a copy");
  if (size == 0) return;
  check_range(source, source_offset, size);
  check_range(target, target_offset, size);
  const VkBufferCopy region = {source_offset, target_offset, size};
  context_.vk.vkCmdCopyBuffer(commands_, buffers_.get(source).buffer, buffers_.get(target).buffer, 1, &region);
}

void VulkanCommandList::copy_buffer_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                             std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) {
  bound_.check_outside("a copy");
  const Image& image = images_.get(target);
  check_transfer_layout(image, {mip, 1, first_layer, layer_count}, Access::transfer_write);
  const VkBufferImageCopy region = packed_region(image.desc, source_offset, mip, first_layer, layer_count);
  check_range(source, source_offset, mip_bytes(image.desc, mip) * layer_count);
  context_.vk.vkCmdCopyBufferToImage(commands_, buffers_.get(source).buffer, image.image,
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void VulkanCommandList::copy_rows_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                           std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) {
  bound_.check_outside("a copy");
  const Image& image = images_.get(target);
  check_transfer_layout(image, {mip, 1, 0, 1}, Access::transfer_write);
  VkBufferImageCopy region = packed_region(image.desc, source_offset, mip, 0, 1);
  const std::uint32_t height = region.imageExtent.height;
  GLOAM_ASSERT(row_count > 0 && first_row < height && row_count <= height - first_row,
               "a copy stays inside image \"" + image.desc.name + "\"");
  check_range(source, source_offset, mip_bytes(image.desc, mip) / height * row_count);
  region.imageOffset.y = static_cast<std::int32_t>(first_row);
  region.imageExtent.height = row_count;
  context_.vk.vkCmdCopyBufferToImage(commands_, buffers_.get(source).buffer, image.image,
                                     VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void VulkanCommandList::copy_image_to_buffer(ImageHandle source, std::uint32_t mip, std::uint32_t layer,
                                             BufferHandle target, std::uint64_t target_offset) {
  bound_.check_outside("a copy");
  const Image& image = images_.get(source);
  check_transfer_layout(image, {mip, 1, layer, 1}, Access::transfer_read);
  const VkBufferImageCopy region = packed_region(image.desc, target_offset, mip, layer, 1);
  check_range(target, target_offset, mip_bytes(image.desc, mip));
  context_.vk.vkCmdCopyImageToBuffer(commands_, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                     buffers_.get(target).buffer, 1, &region);
}

void VulkanCommandList::fill_buffer(BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) {
  bound_.check_outside("a fill");
  if (size == 0) return;
  GLOAM_ASSERT(offset % 4 == 0 && size % 4 == 0, "a buffer is filled in whole words");
  check_range(buffer, offset, size);
  context_.vk.vkCmdFillBuffer(commands_, buffers_.get(buffer).buffer, offset, size, word);
}

void VulkanCommandList::clear_color_image(ImageHandle handle, std::array<std::uint32_t, 4> bits, ImageRange range) {
  bound_.check_outside("a clear");
  const Image& image = images_.get(handle);
  GLOAM_ASSERT(!is_depth(image.desc.format), "a depth image is cleared by rendering to it");
  check_transfer_layout(image, range, Access::transfer_write);
  VkClearColorValue value;
  std::copy(bits.begin(), bits.end(), value.uint32);
  const VkImageSubresourceRange parts = to_vulkan(range, VK_IMAGE_ASPECT_COLOR_BIT);
  context_.vk.vkCmdClearColorImage(commands_, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &parts);
}

void VulkanCommandList::blit(ImageHandle source, ImageHandle target, ImagePart from, ImagePart to) {
  bound_.check_outside("a blit");
  const Image& source_image = images_.get(source);
  const Image& target_image = images_.get(target);
  GLOAM_ASSERT((source_image.desc.shape == ImageShape::volume) == (target_image.desc.shape == ImageShape::volume),
               "a blit goes from a volume to a volume, or between other images");
  check_transfer_layout(source_image, range_of(from), Access::transfer_read);
  check_transfer_layout(target_image, range_of(to), Access::transfer_write);
  const auto corner = [](const ImageDesc& desc, std::uint32_t mip) {
    const VkExtent3D extent = mip_extent(desc, mip);
    return VkOffset3D{static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height),
                      static_cast<std::int32_t>(extent.depth)};
  };
  VkImageBlit region = {};
  region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, from.mip, from.layer, 1};
  region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, to.mip, to.layer, 1};
  region.srcOffsets[1] = corner(source_image.desc, from.mip);
  region.dstOffsets[1] = corner(target_image.desc, to.mip);
  context_.vk.vkCmdBlitImage(commands_, source_image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target_image.image,
                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace gloam::gpu::vulkan
