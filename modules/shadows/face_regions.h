// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/shadows/caster_states.h"
#include "modules/shadows/shadow_views.h"

namespace gloam {

/// Texels of a face, rows from its upper edge: from `begin` to before `end`.
struct TexelRect {
  uvec2 begin = uvec2(0);
  uvec2 end = uvec2(0);
  [[nodiscard]] bool empty() const { return begin.x >= end.x || begin.y >= end.y; }
  [[nodiscard]] std::uint64_t texels() const {
    return empty() ? 0 : std::uint64_t{end.x - begin.x} * (end.y - begin.y);
  }
  [[nodiscard]] bool contains(const TexelRect& other) const {
    return begin.x <= other.begin.x && begin.y <= other.begin.y && end.x >= other.end.x && end.y >= other.end.y;
  }
  bool operator==(const TexelRect&) const = default;
};

[[nodiscard]] TexelRect whole_face(const ShadowFace& face);

/// Corners of regions are multiples of this, in texels: what a thread of shadow_mips.comp takes.
inline constexpr std::uint32_t kRegionStep = 8;
inline constexpr std::size_t kMostRegions = 4;

/// Texels that something in the box may be drawn into, with room for what rounding does; nothing known of the box: all.
[[nodiscard]] TexelRect covered_texels(const ShadowFace& face, const CasterBox& box);

/// Few rectangles that hold all texels that something in one of the boxes may be drawn into: at most kMostRegions, which do not overlap.
/// The whole face when little would be left.
[[nodiscard]] std::vector<TexelRect> covered_regions(const ShadowFace& face, std::span<const CasterBox> boxes);

}  // namespace gloam
