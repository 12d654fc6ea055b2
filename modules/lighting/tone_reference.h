// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/reference/reference.h"

namespace gloam {

/// The curves of shaders/lighting/tone_curve.glsl in double precision; curve: index of the knob's choice. x ≥ 0.
[[nodiscard]] double tone_curve(std::uint32_t curve, double x);

/// The exposure meter.comp gives for a frame's light, in double precision.
[[nodiscard]] double metered_exposure(const LinearPicture& lit);

/// What the drawn light should have become with the chosen curve: exposure, curve and sRGB encoding in double
/// precision, rounded once.
[[nodiscard]] Result<FramePictures> draw_tone_reference(const ReferenceInput& input);

}  // namespace gloam
