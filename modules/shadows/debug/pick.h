// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Copies the final lists out of a frame, for shadow_pick_lines: "shadows.final_tiles", "shadows.final_entries",
/// "shadows.visibilities" and, where there are two buffers, "shadows.visibilities_1".
[[nodiscard]] Status add_shadow_pick_copies(FrameBuilder& frame, Captures& copies);

/// What the final list of a pixel's tile holds, how much of each light the pixel sees, and the lights that were left
/// out, in lines for people.
[[nodiscard]] std::vector<std::string> shadow_pick_lines(FrameBuilder& frame, const PickedPixel& pixel,
                                                         const Captures& copies);

}  // namespace gloam
