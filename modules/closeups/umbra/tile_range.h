// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

/// A rectangle of a view's shadow tiles: [begin, end).
struct TileRange {
  uvec2 begin = uvec2(0);
  uvec2 end = uvec2(0);
  [[nodiscard]] bool empty() const { return begin.x >= end.x || begin.y >= end.y; }
  [[nodiscard]] std::uint64_t tiles() const { return empty() ? 0 : std::uint64_t{end.x - begin.x} * (end.y - begin.y); }
  [[nodiscard]] bool overlaps(const TileRange& other) const {
    return begin.x < other.end.x && begin.y < other.end.y && other.begin.x < end.x && other.begin.y < end.y;
  }
  bool operator==(const TileRange&) const = default;
};

}  // namespace gloam
