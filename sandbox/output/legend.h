// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/render/renderer.h"

namespace gloam {

/// Writes a line of ASCII text into the lower left corner of a picture, white on a dark strip, wrapped at the picture's
/// width. Text that does not fit is cut off; pictures below 64×32 pixels get no text.
void draw_legend(Picture& picture, std::string_view text);

}  // namespace gloam
