// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "engine/render/readback/capture.h"

namespace gloam {

/// The close-up pairs whose tiles hold a pixel, and of those whose frustum holds what it shows: size of the map and
/// texels a pixel's side; in lines for people. Looks at the engine's own copies. Nothing for frames that draw no pair.
[[nodiscard]] std::vector<std::string> closeup_pick_lines(const FrameBuilder& frame, const PickedPixel& pixel,
                                                          const Captures& copies);

}  // namespace gloam
