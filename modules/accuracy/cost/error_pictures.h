// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/readback/picture.h"
#include "modules/accuracy/outputs.h"

// Pictures that show where a frame is wrong.

namespace gloam {

inline constexpr std::size_t kWorstAreas = 3;
inline constexpr std::uint32_t kWorstWidth = 48;  ///< of an area, in pixels; less in smaller pictures
inline constexpr std::uint32_t kWorstHeight = 32;

/// The error in colours from black through violet and orange to pale yellow, by its square root: 0.01 is a tenth of the
/// way. flip: 0…1, width · height values, rows from the top.
[[nodiscard]] Picture heat_map(std::span<const float> flip, std::uint32_t width, std::uint32_t height);

/// Up to kWorstAreas areas with the greatest sum of errors, greatest first: each is the best of all positions that do
/// not overlap the areas before it; of equal ones, the topmost, then the leftmost. Areas without error are left out.
[[nodiscard]] std::vector<PictureArea> worst_areas(std::span<const float> flip, std::uint32_t width,
                                                   std::uint32_t height);

/// The areas below each other, each from `picture` on the left and from `reference` on the right, pixel for pixel,
/// with two black pixels between them. areas: at least one, all of one size.
[[nodiscard]] Picture side_by_side(const Picture& picture, const Picture& reference,
                                   std::span<const PictureArea> areas);

}  // namespace gloam
