// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"

/// Conversions between gloam's and Vulkan's enumerations.
namespace gloam::gpu::vulkan {

[[nodiscard]] VkFormat to_vulkan(Format format);
/// Returns Format::undefined if Format has no equivalent.
[[nodiscard]] Format from_vulkan(VkFormat format);
[[nodiscard]] VkImageAspectFlags aspect_of(Format format);
[[nodiscard]] VkBufferUsageFlags to_vulkan(BufferUsage usage);
[[nodiscard]] VkImageUsageFlags to_vulkan(ImageUsage usage);
[[nodiscard]] VkFilter to_vulkan(Filter filter);
[[nodiscard]] VkSamplerMipmapMode to_mipmap_mode(Filter filter);
[[nodiscard]] VkSamplerAddressMode to_vulkan(AddressMode mode);
[[nodiscard]] VkCompareOp to_vulkan(CompareOp op);
[[nodiscard]] VkCullModeFlags to_vulkan(CullMode mode);
[[nodiscard]] VkAttachmentLoadOp to_vulkan(LoadOp op);
/// The blend state of one colour target. Blending is off for integer formats, which do not support it.
[[nodiscard]] VkPipelineColorBlendAttachmentState to_vulkan(BlendMode mode, Format format);
/// Returns VK_DESCRIPTOR_TYPE_MAX_ENUM for ResourceKind::other.
[[nodiscard]] VkDescriptorType to_vulkan(ResourceKind kind);

}  // namespace gloam::gpu::vulkan
