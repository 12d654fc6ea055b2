// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/renderer.h"

namespace gloam {

/// Writes a line of ASCII text into the lower left corner of a picture, white on a dark strip, wrapped at the picture's
/// width, and above it a bar of the heat scale's colours with their values, if the visualizer has a scale. Text that
/// does not fit is cut off; pictures below 64×32 pixels get neither, and those below 128×72 no bar. Returns how many of
/// the last rows the strip covers.
std::uint32_t draw_legend(Picture& picture, std::string_view text, const HeatScale& heat = {}, float heat_range = 1.0f);

}  // namespace gloam
