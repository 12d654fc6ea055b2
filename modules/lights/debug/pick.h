// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Copies the light lists out of a frame, for light_pick_lines.
[[nodiscard]] Status add_light_pick_copies(FrameBuilder& frame, Captures& copies);

/// A pixel's tiles, depths and bins, and the lights that each search left for it, in lines for people.
[[nodiscard]] std::vector<std::string> light_pick_lines(FrameBuilder& frame, const PickedPixel& pixel,
                                                        const Captures& copies);

}  // namespace gloam
