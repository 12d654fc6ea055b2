// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace gloam {

/// Handle of one entity of one world. After the entity is destroyed, its index is reused with another generation (an
/// index repeats a generation after about 2^32 destructions). Generation 0 never belongs to a living entity.
struct Entity {
  std::uint32_t index = ~0u;
  std::uint32_t generation = 0;
  friend bool operator==(const Entity&, const Entity&) = default;
};

inline constexpr Entity kNoEntity{};

/// "entity 7 (generation 2)", for sentences about it.
[[nodiscard]] std::string text_of(Entity entity);

/// Id of one view (a camera's, a mirror's, …). Resources can be stored per view.
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
