// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "engine/gpu/types.h"

/// The image layout and the usage flags that each Access requires.
namespace gloam::gpu {

/// The image layout that an access requires. Accesses with equal AccessLayout need no layout transition between them.
enum class AccessLayout : std::uint8_t {
  undefined,
  transfer_source,
  transfer_target,
  sampled,
  general,
  color_target,
  depth_target,
  depth_test,
  present,
  buffer_only,  ///< accesses that only buffers support
};

[[nodiscard]] constexpr AccessLayout layout_of(Access access) {
  switch (access) {
    case Access::none:
      return AccessLayout::undefined;
    case Access::transfer_read:
      return AccessLayout::transfer_source;
    case Access::transfer_write:
      return AccessLayout::transfer_target;
    case Access::uniform_read:
    case Access::vertex_read:
    case Access::fragment_read:
    case Access::compute_read:
      return AccessLayout::sampled;
    case Access::compute_storage_read:
    case Access::compute_write:
    case Access::fragment_write:
      return AccessLayout::general;
    case Access::color_target:
      return AccessLayout::color_target;
    case Access::depth_target:
      return AccessLayout::depth_target;
    case Access::depth_test:
      return AccessLayout::depth_test;
    case Access::present:
      return AccessLayout::present;
    case Access::host_read:
    case Access::vertex_input:
    case Access::indirect_read:
      break;
  }
  return AccessLayout::buffer_only;
}

/// The usage flags that an image needs for this access. ImageUsage::none if the access needs no flag or no image
/// supports it.
[[nodiscard]] constexpr ImageUsage image_usage_of(Access access) {
  switch (layout_of(access)) {
    case AccessLayout::transfer_source:
      return ImageUsage::transfer_source;
    case AccessLayout::transfer_target:
      return ImageUsage::transfer_target;
    case AccessLayout::sampled:
      return ImageUsage::sampled;
    case AccessLayout::general:
      return ImageUsage::storage;
    case AccessLayout::color_target:
      return ImageUsage::color_target;
    case AccessLayout::depth_target:
      return ImageUsage::depth_target;
    case AccessLayout::depth_test:
      return ImageUsage::depth_target | ImageUsage::sampled;
    case AccessLayout::undefined:
    case AccessLayout::present:
    case AccessLayout::buffer_only:
      break;
  }
  return ImageUsage::none;
}

/// The usage flags that a buffer needs for this access. BufferUsage::none if the access needs no flag or no buffer
/// supports it.
[[nodiscard]] constexpr BufferUsage buffer_usage_of(Access access) {
  switch (access) {
    case Access::transfer_read:
      return BufferUsage::transfer_source;
    case Access::transfer_write:
      return BufferUsage::transfer_target;
    case Access::vertex_input:
      return BufferUsage::vertex | BufferUsage::index;
    case Access::indirect_read:
      return BufferUsage::indirect;
    case Access::uniform_read:
      return BufferUsage::uniform;
    case Access::vertex_read:
    case Access::fragment_read:
    case Access::compute_read:
    case Access::compute_write:
    case Access::fragment_write:
      return BufferUsage::storage;
    default:
      return BufferUsage::none;
  }
}

[[nodiscard]] constexpr bool fits_image(Access access) {
  return access != Access::none && layout_of(access) != AccessLayout::buffer_only;
}
[[nodiscard]] constexpr bool fits_buffer(Access access) {
  return access == Access::host_read || buffer_usage_of(access) != BufferUsage::none;
}

/// Calls `function(Access)` for every access in the mask, in the order of the enumeration.
template <class Function>
constexpr void for_each_access(AccessMask mask, Function&& function) {
  for (; mask != 0; mask &= mask - 1) function(static_cast<Access>(std::countr_zero(mask)));
}

/// The access of the mask that comes first in the enumeration; Access::none if the mask is empty.
[[nodiscard]] constexpr Access first_of(AccessMask mask) {
  return mask == 0 ? Access::none : static_cast<Access>(std::countr_zero(mask));
}

/// All accesses that an image supports while it stays in this layout.
[[nodiscard]] constexpr AccessMask accesses_in(AccessLayout layout) {
  AccessMask mask = 0;
  for (std::uint32_t a = 1; a <= static_cast<std::uint32_t>(Access::present); ++a) {
    if (layout_of(static_cast<Access>(a)) == layout) mask |= 1u << a;
  }
  return mask;
}

}  // namespace gloam::gpu
