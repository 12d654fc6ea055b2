// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/binding/descriptor_writer.h"

#include <string>

#include "engine/gpu/vulkan/barriers.h"
#include "engine/gpu/vulkan/convert.h"

namespace gloam::gpu::vulkan {
namespace {

/// The view type that the shader declares. Asserts that the image and the number of layers fit it.
VkImageViewType view_type(const ReflectedBinding& slot, const ImageDesc& desc, std::uint32_t layers) {
  GLOAM_ASSERT((slot.dimension == ImageDimension::volume) == (desc.shape == ImageShape::volume),
               "\"" + slot.name + "\" is " + (slot.dimension == ImageDimension::volume ? "a" : "no") +
                   " volume for the shader, unlike image \"" + desc.name + "\"");
  if (slot.dimension == ImageDimension::volume) return VK_IMAGE_VIEW_TYPE_3D;
  if (slot.dimension == ImageDimension::cube) {
    GLOAM_ASSERT(slot.arrayed ? layers % 6 == 0 : layers == 6,
                 "\"" + slot.name + "\" is a cube for the shader and needs six layers a cube");
    return slot.arrayed ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
  }
  GLOAM_ASSERT(slot.arrayed || layers == 1, "\"" + slot.name + "\" has one layer for the shader");
  return slot.arrayed ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

/// Whether the barriers recorded so far left the mips and layers of a view in the general layout, as for a kernel that
/// samples one mip and writes the next of an image that is in one layout. Asserts that the view is in one layout.
bool is_general(const Image& image, const ViewKey& key) {
  const auto general = [](Access access) { return facts_of(access).layout == VK_IMAGE_LAYOUT_GENERAL; };
  std::uint32_t values = 0;
  std::uint32_t generals = 0;
  image.access.visit({key.first_mip, key.mip_count, key.first_layer, key.layer_count}, [&](Access access) {
    ++values;
    generals += general(access) ? 1 : 0;
  });
  GLOAM_ASSERT(generals == 0 || generals == values,
               "the mips and layers of a view of image \"" + image.desc.name + "\" are in one layout");
  return generals > 0;
}

bool is_buffer(ResourceKind kind) {
  return kind == ResourceKind::uniform_buffer || kind == ResourceKind::storage_buffer;
}

std::string wrong_kind(const ReflectedBinding& slot) {
  return "\"" + slot.name + "\" (binding " + std::to_string(slot.binding) + ") is a " +
         std::string(name_of(slot.kind)) + " for the shader";
}

}  // namespace

Result<std::span<const VkWriteDescriptorSet>> DescriptorWriter::build(const Pipeline& pipeline, std::uint32_t set,
                                                                      std::span<const Binding> bindings,
                                                                      VkDescriptorSet target, Layouts layouts) {
  buffer_infos_.clear();
  image_infos_.clear();
  writes_.clear();
  // The writes point into these vectors, so they must not reallocate while they grow.
  buffer_infos_.reserve(bindings.size());
  image_infos_.reserve(bindings.size());
  for (const ReflectedBinding& slot : pipeline.shader.of_set(set)) {
    const std::size_t first_buffer = buffer_infos_.size();
    const std::size_t first_image = image_infos_.size();
    for (const Binding& binding : bindings) {
      if (binding.binding == slot.binding) GLOAM_TRY(add(slot, binding, layouts));
    }
    const std::size_t given = buffer_infos_.size() - first_buffer + image_infos_.size() - first_image;
    GLOAM_ASSERT(given == slot.count || (given == 0 && !slot.used),
                 "pipeline \"" + pipeline.name + "\" needs " + std::to_string(slot.count) + " resource(s) for \"" +
                     slot.name + "\" (set " + std::to_string(set) + ", binding " + std::to_string(slot.binding) +
                     "), and was given " + std::to_string(given));
    if (given == 0) continue;
    writes_.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                       .dstSet = target,
                       .dstBinding = slot.binding,
                       .descriptorCount = static_cast<std::uint32_t>(given),
                       .descriptorType = to_vulkan(slot.kind),
                       .pImageInfo = image_infos_.data() + first_image,
                       .pBufferInfo = buffer_infos_.data() + first_buffer});
  }
  return std::span<const VkWriteDescriptorSet>(writes_);
}

Status DescriptorWriter::add(const ReflectedBinding& slot, const Binding& binding, Layouts layouts) {
  if (const auto* range = std::get_if<Binding::BufferRange>(&binding.resource)) {
    GLOAM_ASSERT(is_buffer(slot.kind), wrong_kind(slot));
    add_buffer(slot, *range);
    return {};
  }
  if (const auto* sampled = std::get_if<Binding::Sampled>(&binding.resource)) {
    GLOAM_ASSERT(slot.kind == ResourceKind::sampled_image, wrong_kind(slot));
    return add_image(slot, sampled->view, samplers_.get(sampled->sampler), layouts);
  }
  GLOAM_ASSERT(slot.kind == ResourceKind::storage_image, wrong_kind(slot));
  return add_image(slot, std::get<Binding::Storage>(binding.resource).view, VK_NULL_HANDLE, layouts);
}

void DescriptorWriter::add_buffer(const ReflectedBinding& slot, const Binding::BufferRange& range) {
  const Buffer& buffer = buffers_.get(range.buffer);
  GLOAM_ASSERT(range.offset < buffer.desc.size, "a bound range of \"" + buffer.desc.name + "\" begins inside it");
  const std::uint64_t remaining = buffer.desc.size - range.offset;
  GLOAM_ASSERT(range.size <= remaining, "a bound range of \"" + buffer.desc.name + "\" ends inside it");
  const std::uint64_t size = range.size == 0 ? remaining : range.size;
  const VkPhysicalDeviceLimits& limits = context_.physical.limits;
  const std::uint64_t most =
      slot.kind == ResourceKind::uniform_buffer ? limits.maxUniformBufferRange : limits.maxStorageBufferRange;
  GLOAM_ASSERT(size <= most, "the bound range of \"" + buffer.desc.name + "\" is larger than the device can bind");
  buffer_infos_.push_back({buffer.buffer, range.offset, size});
}

Status DescriptorWriter::add_image(const ReflectedBinding& slot, const ImageView& view, VkSampler sampler,
                                   Layouts layouts) {
  const Image& image = images_.get(view.image);
  ViewKey key = resolve_view(image.desc, view);
  key.type = view_type(slot, image.desc, key.layer_count);
  const bool storage = slot.kind == ResourceKind::storage_image;
  if (storage) key.mip_count = 1;  // a storage image has one mip
  const Result<VkImageView> vk_view = images_.view(view.image, key);
  if (!vk_view) return vk_view.error();
  const bool general = storage || (layouts == Layouts::as_recorded && is_general(image, key));
  image_infos_.push_back({sampler, *vk_view, general ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL});
  return {};
}

}  // namespace gloam::gpu::vulkan
