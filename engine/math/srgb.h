// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

namespace gloam {

/// sRGB transfer function of one channel (IEC 61966-2-1), exact piecewise form. Argument in [0, 1]; it is not clamped.
/// shaders/common/math.glsl has the same functions.
[[nodiscard]] float srgb_to_linear(float srgb);
[[nodiscard]] double srgb_to_linear(double srgb);
[[nodiscard]] float linear_to_srgb(float linear);
[[nodiscard]] double linear_to_srgb(double linear);

}  // namespace gloam
