// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// Readable lines about a pixel: the close-up pairs whose umbra range holds it, with the size of the pair's face and,
/// if its frustum holds the visible surface, the texels per pixel side. Reads only the engine's copies. Empty for
/// frames that draw no pair.
[[nodiscard]] std::vector<std::string> closeup_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                                          const Captures& copies);

}  // namespace gloam
