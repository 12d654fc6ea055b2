// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/reference/reference.h"

namespace gloam {

/// A world resource while a frame is one of many whose mean is the picture: its pixels are points, without filters over
/// a pixel's area.
struct PointSampledFrame {};

/// The mean of pictures whose pixels were sampled at different points, in linear light. Draws a frame for
/// every four of the input's samples, from 1 to 64.
[[nodiscard]] Result<FramePictures> draw_supersampled(const ReferenceInput& input);

}  // namespace gloam
