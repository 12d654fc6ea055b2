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

/// Corners of regions are multiples of this many texels: the block that one thread of mips.comp processes.
inline constexpr std::uint32_t kRegionStep = 8;
/// Most regions of a face that are drawn separately in one frame.
inline constexpr std::size_t kMostRegions = 4;

/// The texels that casters in the box may be drawn into, with a margin for rounding; the whole face when the box is
/// unknown.
[[nodiscard]] TexelRect covered_texels(const ShadowFace& face, const CasterBox& box);

/// At most kMostRegions rectangles, not overlapping, that hold all texels that casters in the boxes may be drawn into.
/// The whole face when the rectangles would cover most of it. Empty when the face sees none of the boxes.
[[nodiscard]] std::vector<TexelRect> covered_regions(const ShadowFace& face, std::span<const CasterBox> boxes);

}  // namespace gloam
