// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace gloam {

/// Number of a component type within one world, in order of registration.
using ComponentId = std::uint16_t;
inline constexpr ComponentId kNoComponent = 0xffff;

/// Stamp of a change; a world counts them up from 1 and never back.
using Tick = std::uint64_t;

/// Changes are stamped a block of so many rows.
inline constexpr std::uint32_t kTickBlockRows = 4096;

/// So many first rows of an archetype, or as many as fit kFrontBytes, lie packed beside those of other archetypes.
inline constexpr std::uint32_t kFrontRows = 128;
inline constexpr std::size_t kFrontBytes = 16384;

/// Every column begins at a multiple of this, so no component may ask for more.
inline constexpr std::size_t kColumnAlignment = 64;

struct ComponentInfo {
  std::string name;
  const void* key = nullptr;
  std::uint32_t size = 0;  ///< bytes a row; 0 for a tag (an empty struct)
};

/// What World and View demand of a component type: plain data.
template <class T>
constexpr void require_component() {
  static_assert(std::is_trivially_copyable_v<T>, "components are plain structs: trivially copyable");
  static_assert(!std::is_const_v<T> && !std::is_reference_v<T>, "name the component type itself");
  static_assert(alignof(T) <= kColumnAlignment, "columns are aligned to 64 bytes");
}

template <class T>
inline constexpr std::uint32_t kComponentSize = std::is_empty_v<T> ? 0u : static_cast<std::uint32_t>(sizeof(T));

}  // namespace gloam
