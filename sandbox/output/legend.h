// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/render/renderer.h"

namespace gloam {

/// Writes a line of ASCII text into the lower left corner of a picture, white on a dark strip, wrapped at the picture's
/// width. What does not fit on a small picture is left out.
void draw_legend(Picture& picture, std::string_view text);

}  // namespace gloam
