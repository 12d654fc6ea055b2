// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Texels along the height of the finest image of glare; 0: no glare.
inline constexpr ChoiceKnob<std::uint32_t> kGlareLines{
    .name = "glare.lines",
    .meaning =
        "lines of the finest image in which the light that the lens scatters is spread, at any size of the picture; "
        "off: no lens scatters light",
    .choices = {{"off", 0}, {"45", 45}, {"90", 90}, {"180", 180}},
    .default_value = 90,
    .exact = 180};

}  // namespace gloam
