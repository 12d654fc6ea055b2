// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Adds readbacks of the final lists for shadow_pick_lines(): "shadows.depth_bounds", "shadows.final_tiles",
/// "shadows.final_entries", "shadows.visibilities" and, with two visibility buffers, "shadows.visibilities_1". None
/// without final lists.
[[nodiscard]] Status add_shadow_pick_copies(FrameBuilder& frame, Captures& copies);

/// Lines of text about the pixel's tile: the lights of its final list, their visibility at the pixel, and the lights
/// that were left out. Empty without final lists.
[[nodiscard]] std::vector<std::string> shadow_pick_lines(FrameBuilder& frame, const PickedPixel& pixel,
                                                         const Captures& copies);

}  // namespace gloam
