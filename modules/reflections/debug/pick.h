// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Declares copies of the reflection images, if the frame has them.
[[nodiscard]] Status add_reflection_pick_copies(FrameBuilder& frame, Captures& copies);

/// Readable lines about a pixel's reflection: the tier that gives most of it, the confidence of screen space, the
/// nearest proxy that the mirrored ray meets, and the distance to the hit. Empty for frames without reflections.
[[nodiscard]] std::vector<std::string> reflection_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                                             const Captures& copies);

}  // namespace gloam
