// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/subresources.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/resources/memory.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// The view type, mips and layers of a VkImageView.
struct ViewKey {
  VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D;
  std::uint32_t first_mip = 0;
  std::uint32_t mip_count = 1;
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 1;
  bool operator==(const ViewKey&) const = default;
};

struct Image {
  ImageDesc desc;
  VkImage image = VK_NULL_HANDLE;
  AllocationOwner memory;  ///< null: an adopted image, which is not destroyed here
  std::vector<std::pair<ViewKey, VkImageView>> views;
  /// The access that the last recorded barrier left each mip and layer ready for. Only the recording thread uses it.
  Subresources<Access> access;
};

/// The mips and layers of a view. Asserts that the view lies inside the image.
[[nodiscard]] ImageRange range_of(const ImageDesc& desc, const ImageView& view);
/// Replaces counts of 0 by actual counts and asserts that the view lies inside the image. The caller sets `type`.
[[nodiscard]] ViewKey resolve_view(const ImageDesc& desc, const ImageView& view);

/// Whether the device supports a format for all of these uses, as in Device::supports.
[[nodiscard]] bool supports(const Context& context, Format format, ImageUsage usage);
[[nodiscard]] bool supports_blit(const Context& context, Format format);

/// Creates, stores and destroys images and their views. Thread-safe, except Image::access.
class Images {
 public:
  Images(Context& context, MemoryAllocator& memory, Graveyard& graveyard)
      : context_(context), memory_(memory), graveyard_(graveyard) {}
  ~Images();

  [[nodiscard]] Result<ImageHandle> create(const ImageDesc& desc);
  /// Creates an image inside a memory block. offset: bytes from the begin of the block.
  [[nodiscard]] Result<ImageHandle> create_in(const ImageDesc& desc, const AllocationOwner& block,
                                              std::uint64_t offset);
  [[nodiscard]] Result<MemoryNeeds> needs(const ImageDesc& desc) const;
  [[nodiscard]] Result<std::vector<ImageHandle>> create_aliased(std::span<const ImageDesc> descs);
  /// Adds an image owned by a window or a host. Destroying the handle destroys only the image's views.
  [[nodiscard]] ImageHandle adopt(const ImageDesc& desc, VkImage image);
  void destroy(ImageHandle handle);
  [[nodiscard]] bool alive(ImageHandle handle) const { return table_.alive(handle); }
  [[nodiscard]] const Image& get(ImageHandle handle) const { return table_.get(handle); }
  [[nodiscard]] Image& get(ImageHandle handle) { return table_.get(handle); }
  /// Returns the view with this key. Each view is created once and lives as long as its image.
  [[nodiscard]] Result<VkImageView> view(ImageHandle handle, const ViewKey& key);

 private:
  [[nodiscard]] Result<Image> make(const ImageDesc& desc) const;
  /// offset: bytes from the begin of `memory`.
  [[nodiscard]] Status bind(Image& image, AllocationOwner memory, std::uint64_t offset) const;
  void release(const Image& image) const;

  Context& context_;
  MemoryAllocator& memory_;
  Graveyard& graveyard_;
  std::mutex views_mutex_;
  HandleTable<Image, ImageHandle> table_;
};

}  // namespace gloam::gpu::vulkan
