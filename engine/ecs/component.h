// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "engine/ecs/type_key.h"

namespace gloam {

/// Id of a component type within one world; ids follow the order of registration.
using ComponentId = std::uint16_t;
inline constexpr ComponentId kNoComponent = 0xffff;

/// Time stamp of a change. A world counts ticks up from 1 and never back.
using Tick = std::uint64_t;

/// Rows per block. Changes are stamped per block.
inline constexpr std::uint32_t kTickBlockRows = 4096;

/// The first kFrontRows rows of an archetype, or as many as fit into kFrontBytes, lie in memory shared with the first
/// rows of other archetypes.
inline constexpr std::uint32_t kFrontRows = 128;
inline constexpr std::size_t kFrontBytes = 16384;

/// Every column begins at a multiple of this many bytes, so a component's alignment must not be greater.
inline constexpr std::size_t kColumnAlignment = 64;

struct ComponentInfo {
  std::string name;
  TypeKey key = TypeKey::none;
  std::uint32_t size = 0;  ///< bytes per row; 0 for a tag (an empty struct)
};

/// Asserts at compile time that T may be a component: plain data.
template <class T>
constexpr void require_component() {
  static_assert(std::is_trivially_copyable_v<T>, "components are plain structs: trivially copyable");
  static_assert(!std::is_const_v<T> && !std::is_reference_v<T>, "name the component type itself");
  static_assert(alignof(T) <= kColumnAlignment, "columns are aligned to 64 bytes");
}

template <class T>
inline constexpr std::uint32_t kComponentSize = std::is_empty_v<T> ? 0u : static_cast<std::uint32_t>(sizeof(T));

}  // namespace gloam
