// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/module.h"
#include "engine/render/readback/capture.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/frame.h"

namespace gloam {

/// Copies of the sorted blades and of the knots.
[[nodiscard]] Status add_grass_pick_copies(FrameBuilder& frame, const GrassFrame& grass, Captures& copies);

/// Names the live blade that the pixel shows, with its master; nothing if no blade is near the surface point.
[[nodiscard]] std::vector<std::string> grass_pick_lines(const FrameBuilder& frame, const GrassFrame& grass,
                                                        const PickedPixel& pixel, const Captures& copies);

}  // namespace gloam
