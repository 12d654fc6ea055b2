// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "engine/render/view.h"

namespace gloam {

/// The point of a pixel that the frame shows, from the pixel's centre, in [-0.5, 0.5): pixels to the right and down.
/// index: number of the frame, from 0, which shows the centre. The points repeat after kJitterPoints frames; 2^k
/// frames from a multiple of 2^k on have a point in each of 2^k boxes of equal size, of any shape.
inline constexpr std::uint32_t kJitterPoints = 64;
[[nodiscard]] vec2 jitter_point(std::uint64_t index);

/// Makes pixel centres show the scene at `pixels` from them: sets RenderView::jitter, moves the projection of this
/// frame and of `previous` by the same way, and updates what follows from it. The frustum becomes that of all points of
/// the pixels. A perspective projection is sheared. An orthographic camera moves across its direction, because not all
/// code expects an orthographic projection off the axis.
void apply_jitter(RenderView& view, const vec2& pixels);

}  // namespace gloam
