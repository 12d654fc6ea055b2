// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace gloam {

/// sRGB transfer function of one channel (IEC 61966-2-1), exact piecewise form. Argument in [0, 1]; it is not clamped.
/// shaders/common/math.glsl has the same functions.
[[nodiscard]] float srgb_to_linear(float srgb);
[[nodiscard]] double srgb_to_linear(double srgb);
[[nodiscard]] float linear_to_srgb(float linear);
[[nodiscard]] double linear_to_srgb(double linear);

/// srgb_to_linear() of each byte over 255.
[[nodiscard]] const std::array<float, 256>& linear_of_srgb();

}  // namespace gloam
