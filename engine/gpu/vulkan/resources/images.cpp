// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/images.h"

#include <algorithm>
#include <string>

#include "engine/gpu/image_size.h"
#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"
#include "engine/gpu/vulkan/resources/memory_blocks.h"

namespace gloam::gpu::vulkan {
namespace {

std::string cannot_make(const ImageDesc& desc) {
  return "Image \"" + desc.name + "\" of module \"" + desc.module + "\" (" + std::to_string(desc.width) + "x" +
         std::to_string(desc.height) + (desc.shape == ImageShape::volume ? "x" + std::to_string(desc.depth) : "") +
         ", " + std::to_string(desc.layers) + " layers, " + std::string(name_of(desc.format)) + ") could not be made";
}

VkFormatFeatureFlags features_needed(ImageUsage usage) {
  VkFormatFeatureFlags needed = 0;
  if (has(usage, ImageUsage::transfer_source)) needed |= VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
  if (has(usage, ImageUsage::transfer_target)) needed |= VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
  if (has(usage, ImageUsage::sampled)) needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
  if (has(usage, ImageUsage::storage)) needed |= VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
  if (has(usage, ImageUsage::color_target)) needed |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
  if (has(usage, ImageUsage::depth_target)) needed |= VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
  return needed;
}

/// The formats that shaders may name for storage images without shaderStorageImageExtendedFormats.
bool is_basic_storage(Format format) {
  switch (format) {
    case Format::rgba8_unorm:
    case Format::rgba16_float:
    case Format::r32_uint:
    case Format::rgba32_uint:
    case Format::r32_float:
    case Format::rgba32_float:
    case Format::rgba8_uint:
    case Format::rgba16_uint:
      return true;
    default:
      return false;
  }
}

VkFormatFeatureFlags features_of(const Context& context, Format format) {
  VkFormatProperties properties;
  context.instance_functions().vkGetPhysicalDeviceFormatProperties(context.physical.handle, to_vulkan(format),
                                                                   &properties);
  return properties.optimalTilingFeatures;
}

void check_rules(const ImageDesc& desc) {
  GLOAM_ASSERT(desc.format != Format::undefined, "an image has a format");
  GLOAM_ASSERT(desc.usage != ImageUsage::none, "an image must be used for something");
  GLOAM_ASSERT(desc.width > 0 && desc.height > 0 && desc.depth > 0 && desc.layers > 0 && desc.mips > 0,
               "an image holds a texel");
  const bool volume = desc.shape == ImageShape::volume;
  GLOAM_ASSERT((desc.shape != ImageShape::plain && !volume) || desc.layers == 1,
               "a plain image has one layer, and so has a volume");
  GLOAM_ASSERT(volume || desc.depth == 1, "only a volume has a depth");
  GLOAM_ASSERT(!volume || (!is_depth(desc.format) && !has(desc.usage, ImageUsage::color_target)),
               "a volume is sampled, written by shaders and copied, never a target");
  GLOAM_ASSERT(desc.shape != ImageShape::cube || (desc.layers % 6 == 0 && desc.width == desc.height),
               "a cube image is square and has six layers a cube");
  GLOAM_ASSERT(desc.mips <= full_mip_count(desc), "an image has no more mips than it can be halved");
}

std::uint32_t largest_side(const VkPhysicalDeviceLimits& limits, ImageShape shape) {
  switch (shape) {
    case ImageShape::cube:
      return limits.maxImageDimensionCube;
    case ImageShape::volume:
      return limits.maxImageDimension3D;
    case ImageShape::plain:
    case ImageShape::array:
      break;
  }
  return limits.maxImageDimension2D;
}

Status check_limits(const Context& context, const ImageDesc& desc) {
  const VkPhysicalDeviceLimits& limits = context.physical.limits;
  const std::uint32_t most = largest_side(limits, desc.shape);
  if (std::max({desc.width, desc.height, desc.depth}) > most) {
    return Error{ErrorKind::failed,
                 cannot_make(desc) + ": the device allows " + std::to_string(most) + " texels a side"};
  }
  if (desc.layers > limits.maxImageArrayLayers) {
    return Error{ErrorKind::failed,
                 cannot_make(desc) + ": the device allows " + std::to_string(limits.maxImageArrayLayers) + " layers"};
  }
  if (!supports(context, desc.format, desc.usage)) {
    return Error{ErrorKind::failed,
                 cannot_make(desc) + ": the device cannot use this format in that way (" + text_of(desc.usage) + ")"};
  }
  return {};
}

VkImageCreateInfo create_info(const ImageDesc& desc) {
  const bool cube = desc.shape == ImageShape::cube;
  return {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
          .flags = cube ? static_cast<VkImageCreateFlags>(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0,
          .imageType = desc.shape == ImageShape::volume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
          .format = to_vulkan(desc.format),
          .extent = {desc.width, desc.height, desc.depth},
          .mipLevels = desc.mips,
          .arrayLayers = desc.layers,
          .samples = VK_SAMPLE_COUNT_1_BIT,
          .tiling = VK_IMAGE_TILING_OPTIMAL,
          .usage = to_vulkan(desc.usage),
          .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
          .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
}

}  // namespace

bool supports(const Context& context, Format format, ImageUsage usage) {
  if (format == Format::undefined) return false;
  const bool extended = context.physical.features.core.features.shaderStorageImageExtendedFormats == VK_TRUE;
  if (has(usage, ImageUsage::storage) && !extended && !is_basic_storage(format)) return false;
  const VkFormatFeatureFlags features = features_of(context, format);
  const VkFormatFeatureFlags needed = features_needed(usage);
  return features != 0 && (features & needed) == needed;
}

bool supports_blit(const Context& context, Format format) {
  constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                           VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  if (format == Format::undefined || is_depth(format) || is_integer(format)) return false;
  return (features_of(context, format) & kNeeded) == kNeeded;
}

ImageRange range_of(const ImageDesc& desc, const ImageView& view) {
  return resolve({view.first_mip, view.mip_count, view.first_layer, view.layer_count}, desc);
}

ViewKey resolve_view(const ImageDesc& desc, const ImageView& view) {
  const ImageRange range = range_of(desc, view);
  return {.first_mip = range.first_mip,
          .mip_count = range.mip_count,
          .first_layer = range.first_layer,
          .layer_count = range.layer_count};
}

Images::~Images() {
  for (const Image& image : table_.remove_all()) release(image);
}

Result<Image> Images::make(const ImageDesc& desc) const {
  check_rules(desc);
  GLOAM_TRY(check_limits(context_, desc));
  const VkImageCreateInfo info = create_info(desc);
  Image image;
  image.desc = desc;
  image.access = Subresources<Access>(desc.mips, desc.layers);
  const VkResult result = context_.vk.vkCreateImage(context_.device, &info, context_.allocation, &image.image);
  if (result != VK_SUCCESS) return failure(cannot_make(desc), result);
  context_.set_name(VK_OBJECT_TYPE_IMAGE, image.image, desc.name);
  return image;
}

Status Images::bind(Image& image, AllocationOwner memory, std::uint64_t offset) const {
  image.memory = std::move(memory);
  const VkResult result =
      context_.vk.vkBindImageMemory(context_.device, image.image, image.memory->memory, image.memory->offset + offset);
  if (result != VK_SUCCESS) return failure(cannot_make(image.desc), result);
  return {};
}

Result<MemoryNeeds> Images::needs(const ImageDesc& desc) const {
  check_rules(desc);
  GLOAM_TRY(check_limits(context_, desc));
  const VkImageCreateInfo info = create_info(desc);
  const VkDeviceImageMemoryRequirements query = {.sType = VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS,
                                                 .pCreateInfo = &info};
  VkMemoryRequirements2 requirements = {.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  context_.vk.vkGetDeviceImageMemoryRequirements(context_.device, &query, &requirements);
  return needs_in_block(context_, requirements.memoryRequirements);
}

Result<ImageHandle> Images::create_in(const ImageDesc& desc, const AllocationOwner& block, std::uint64_t offset) {
  const Result<MemoryNeeds> needed = needs(desc);
  if (!needed) return needed.error();
  check_place(*block, *needed, offset, desc.name);
  Result<Image> image = make(desc);
  if (!image) return image.error();
  if (const Status bound = bind(*image, block, offset); !bound) {
    context_.vk.vkDestroyImage(context_.device, image->image, context_.allocation);
    return bound.error();
  }
  return table_.insert(std::move(*image));
}

Result<ImageHandle> Images::create(const ImageDesc& desc) {
  Result<std::vector<ImageHandle>> images = create_aliased({&desc, 1});
  if (!images) return images.error();
  return images->front();
}

Result<std::vector<ImageHandle>> Images::create_aliased(std::span<const ImageDesc> descs) {
  GLOAM_ASSERT(!descs.empty(), "there must be an image to make");
  std::vector<Image> images;
  const auto fail = [&](const Error& error) {
    for (const Image& image : images) context_.vk.vkDestroyImage(context_.device, image.image, context_.allocation);
    return error;
  };
  MemoryRequest request = {.image = true, .module = descs.front().module, .name = descs.front().name};
  request.requirements = {.size = 0, .alignment = 1, .memoryTypeBits = ~0u};
  for (const ImageDesc& desc : descs) {
    Result<Image> image = make(desc);
    if (!image) return fail(image.error());
    VkMemoryRequirements needs;
    context_.vk.vkGetImageMemoryRequirements(context_.device, image->image, &needs);
    request.requirements.size = std::max(request.requirements.size, needs.size);
    request.requirements.alignment = std::max(request.requirements.alignment, needs.alignment);
    request.requirements.memoryTypeBits &= needs.memoryTypeBits;
    images.push_back(std::move(*image));
  }
  const Result<AllocationOwner> memory = memory_.allocate(request);
  if (!memory) return fail(memory.error());
  for (Image& image : images) {
    if (const Status bound = bind(image, *memory, 0); !bound) return fail(bound.error());
  }
  std::vector<ImageHandle> handles;
  for (Image& image : images) handles.push_back(table_.insert(std::move(image)));
  return handles;
}

ImageHandle Images::adopt(const ImageDesc& desc, VkImage vk_image) {
  check_rules(desc);
  Image image;
  image.desc = desc;
  image.access = Subresources<Access>(desc.mips, desc.layers);
  image.image = vk_image;
  return table_.insert(std::move(image));
}

void Images::release(const Image& image) const {
  for (const auto& [key, view] : image.views)
    context_.vk.vkDestroyImageView(context_.device, view, context_.allocation);
  if (image.memory) context_.vk.vkDestroyImage(context_.device, image.image, context_.allocation);
}

void Images::destroy(ImageHandle handle) {
  graveyard_.bury([this, image = table_.remove(handle)] { release(image); });
}

Result<VkImageView> Images::view(ImageHandle handle, const ViewKey& key) {
  Image& image = get(handle);
  const std::lock_guard lock(views_mutex_);
  for (const auto& [known, view] : image.views) {
    if (known == key) return view;
  }
  const VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                      .image = image.image,
                                      .viewType = key.type,
                                      .format = to_vulkan(image.desc.format),
                                      .subresourceRange = {aspect_of(image.desc.format), key.first_mip, key.mip_count,
                                                           key.first_layer, key.layer_count}};
  VkImageView view = VK_NULL_HANDLE;
  const VkResult result = context_.vk.vkCreateImageView(context_.device, &info, context_.allocation, &view);
  if (result != VK_SUCCESS) return failure("A view of image \"" + image.desc.name + "\" could not be made", result);
  context_.set_name(VK_OBJECT_TYPE_IMAGE_VIEW, view, image.desc.name);
  image.views.emplace_back(key, view);
  return view;
}

}  // namespace gloam::gpu::vulkan
