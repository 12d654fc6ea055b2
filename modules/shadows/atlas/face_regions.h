// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/shadows/atlas/caster_states.h"
#include "modules/shadows/atlas/view_faces.h"

namespace gloam {

[[nodiscard]] TexelRect whole_face(const ShadowFace& face);

/// Corners of regions are multiples of this, in texels: what a thread of shadow_mips.comp takes.
inline constexpr std::uint32_t kRegionStep = 8;
inline constexpr std::size_t kMostRegions = 4;

/// Texels that something in the box may be drawn into, with room for what rounding does; nothing known of the box: all.
[[nodiscard]] TexelRect covered_texels(const ShadowFace& face, const CasterBox& box);

/// Few rectangles that hold all texels that something in one of the boxes may be drawn into: at most kMostRegions,
/// which do not overlap. The whole face when little would be left.
[[nodiscard]] std::vector<TexelRect> covered_regions(const ShadowFace& face, std::span<const CasterBox> boxes);

}  // namespace gloam
