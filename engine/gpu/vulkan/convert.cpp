// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/convert.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/assert.h"

namespace gloam::gpu::vulkan {
namespace {

// In the order of Format.
constexpr std::array kFormats = {
    VK_FORMAT_UNDEFINED,
    VK_FORMAT_R8_UNORM,
    VK_FORMAT_R8G8B8A8_UNORM,
    VK_FORMAT_R8G8B8A8_SRGB,
    VK_FORMAT_B8G8R8A8_UNORM,
    VK_FORMAT_B8G8R8A8_SRGB,
    VK_FORMAT_A2B10G10R10_UNORM_PACK32,
    VK_FORMAT_B10G11R11_UFLOAT_PACK32,
    VK_FORMAT_R16_UINT,
    VK_FORMAT_R16_SFLOAT,
    VK_FORMAT_R16_UNORM,
    VK_FORMAT_R16G16_UNORM,
    VK_FORMAT_R16G16_SNORM,
    VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R16G16B16A16_SFLOAT,
    VK_FORMAT_R32_UINT,
    VK_FORMAT_R32G32_UINT,
    VK_FORMAT_R32G32B32A32_UINT,
    VK_FORMAT_R32_SFLOAT,
    VK_FORMAT_R32G32_SFLOAT,
    VK_FORMAT_R32G32B32_SFLOAT,
    VK_FORMAT_R32G32B32A32_SFLOAT,
    VK_FORMAT_R8G8B8A8_UINT,
    VK_FORMAT_R16G16B16A16_UINT,
    VK_FORMAT_D32_SFLOAT,
};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::d32_float) + 1);

constexpr std::array kBufferUsages = {
    std::pair{BufferUsage::transfer_source, VK_BUFFER_USAGE_TRANSFER_SRC_BIT},
    std::pair{BufferUsage::transfer_target, VK_BUFFER_USAGE_TRANSFER_DST_BIT},
    std::pair{BufferUsage::uniform, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT},
    std::pair{BufferUsage::storage, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT},
    std::pair{BufferUsage::index, VK_BUFFER_USAGE_INDEX_BUFFER_BIT},
    std::pair{BufferUsage::vertex, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT},
    std::pair{BufferUsage::indirect, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT},
};

constexpr std::array kImageUsages = {
    std::pair{ImageUsage::transfer_source, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
    std::pair{ImageUsage::transfer_target, VK_IMAGE_USAGE_TRANSFER_DST_BIT},
    std::pair{ImageUsage::sampled, VK_IMAGE_USAGE_SAMPLED_BIT},
    std::pair{ImageUsage::storage, VK_IMAGE_USAGE_STORAGE_BIT},
    std::pair{ImageUsage::color_target, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
    std::pair{ImageUsage::depth_target, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
};

}  // namespace

VkFormat to_vulkan(Format format) {
  const auto index = static_cast<std::size_t>(format);
  GLOAM_ASSERT(index < kFormats.size(), "a format must be one of the enumeration");
  return kFormats[index];
}

Format from_vulkan(VkFormat format) {
  const auto found = std::find(kFormats.begin(), kFormats.end(), format);
  return found == kFormats.end() ? Format::undefined : static_cast<Format>(found - kFormats.begin());
}

VkImageAspectFlags aspect_of(Format format) {
  return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkBufferUsageFlags to_vulkan(BufferUsage usage) {
  VkBufferUsageFlags flags = 0;
  for (const auto& [ours, theirs] : kBufferUsages) {
    if (has(usage, ours)) flags |= theirs;
  }
  return flags;
}

VkImageUsageFlags to_vulkan(ImageUsage usage) {
  VkImageUsageFlags flags = 0;
  for (const auto& [ours, theirs] : kImageUsages) {
    if (has(usage, ours)) flags |= theirs;
  }
  return flags;
}

VkFilter to_vulkan(Filter filter) { return filter == Filter::nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR; }

VkSamplerMipmapMode to_mipmap_mode(Filter filter) {
  return filter == Filter::nearest ? VK_SAMPLER_MIPMAP_MODE_NEAREST : VK_SAMPLER_MIPMAP_MODE_LINEAR;
}

VkSamplerAddressMode to_vulkan(AddressMode mode) {
  switch (mode) {
    case AddressMode::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case AddressMode::mirrored_repeat:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case AddressMode::clamp_to_edge:
      break;
  }
  return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

VkCompareOp to_vulkan(CompareOp op) {
  switch (op) {
    case CompareOp::never:
      return VK_COMPARE_OP_NEVER;
    case CompareOp::less:
      return VK_COMPARE_OP_LESS;
    case CompareOp::less_equal:
      return VK_COMPARE_OP_LESS_OR_EQUAL;
    case CompareOp::equal:
      return VK_COMPARE_OP_EQUAL;
    case CompareOp::greater:
      return VK_COMPARE_OP_GREATER;
    case CompareOp::greater_equal:
      return VK_COMPARE_OP_GREATER_OR_EQUAL;
    case CompareOp::always:
      break;
  }
  return VK_COMPARE_OP_ALWAYS;
}

VkCullModeFlags to_vulkan(CullMode mode) {
  switch (mode) {
    case CullMode::none:
      return VK_CULL_MODE_NONE;
    case CullMode::front:
      return VK_CULL_MODE_FRONT_BIT;
    case CullMode::back:
      break;
  }
  return VK_CULL_MODE_BACK_BIT;
}

VkAttachmentLoadOp to_vulkan(LoadOp op) {
  switch (op) {
    case LoadOp::load:
      return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LoadOp::clear:
      return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LoadOp::discard:
      break;
  }
  return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}

VkPipelineColorBlendAttachmentState to_vulkan(BlendMode mode, Format format) {
  VkPipelineColorBlendAttachmentState state = {};
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  if (mode == BlendMode::opaque || is_integer(format)) return state;
  const bool additive = mode == BlendMode::additive;
  state.blendEnable = VK_TRUE;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  state.srcColorBlendFactor = mode == BlendMode::alpha ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = additive ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.srcAlphaBlendFactor = mode == BlendMode::premultiplied_over ? VK_BLEND_FACTOR_ZERO : VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = state.dstColorBlendFactor;
  return state;
}

VkDescriptorType to_vulkan(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::uniform_buffer:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case ResourceKind::storage_buffer:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case ResourceKind::sampled_image:
      return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case ResourceKind::storage_image:
      return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case ResourceKind::other:
      break;
  }
  return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

}  // namespace gloam::gpu::vulkan
