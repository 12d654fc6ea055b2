// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Pixels of the picture along a pixel's side of the blurred image.
inline constexpr ChoiceKnob<std::uint32_t> kFogDivisor{
    .name = "fog.resolution",
    .meaning = "size of the image in which the fog's glow is blurred, relative to the picture",
    .choices = {{"full", 1}, {"half", 2}, {"quarter", 4}},
    .default_value = 4,
    .exact = 1};
inline constexpr NumberKnob kFogRadius{.name = "fog.radius",
                                       .meaning = "radius at which the Gaussian blur of the fog's glow is cut off",
                                       .min = 0.5,
                                       .max = 6.0,
                                       .default_value = 2.5,
                                       .exact = 6.0,
                                       .unit = "standard deviations",
                                       .ledger_values = {1.0, 2.0, 2.5, 3.0, 4.0}};

}  // namespace gloam
