// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/reference/reference.h"

namespace gloam {

/// The mean of pictures whose pixels were sampled at different points, in linear light. Draws up to 64 frames.
[[nodiscard]] Result<FramePictures> draw_supersampled(const ReferenceInput& input);

/// Of lighting.antialiasing.
[[nodiscard]] ReferenceInfo antialiasing_reference();

}  // namespace gloam
