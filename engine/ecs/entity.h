// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gloam {

/// Names one entity of one world. The index is reused after the entity is destroyed, the pair is not (a slot repeats
/// after 2^32 destructions). Generation 0 never names a living entity.
struct Entity {
  std::uint32_t index = ~0u;
  std::uint32_t generation = 0;
  friend bool operator==(const Entity&, const Entity&) = default;
};

inline constexpr Entity kNoEntity{};

/// Names one view (a camera's picture, a mirror's, …) that has resources of its own.
struct ViewId {
  std::uint32_t value = 0;
  friend bool operator==(const ViewId&, const ViewId&) = default;
};

}  // namespace gloam

template <>
struct std::hash<gloam::Entity> {
  std::size_t operator()(const gloam::Entity& e) const noexcept {
    return std::hash<std::uint64_t>()((std::uint64_t{e.generation} << 32) | e.index);
  }
};
