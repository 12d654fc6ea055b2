// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Adds copies of the frame's light lists to `copies`, for light_pick_lines. Does nothing in a frame without lists.
[[nodiscard]] Status add_light_pick_copies(FrameBuilder& frame, Captures& copies);

/// Readable lines about a pixel: its tiles, depths and bins, and the lights that remain after each search.
[[nodiscard]] std::vector<std::string> light_pick_lines(FrameBuilder& frame, const PickedPixel& pixel,
                                                        const Captures& copies);

}  // namespace gloam
