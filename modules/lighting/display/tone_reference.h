// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "engine/render/reference/reference.h"
#include "modules/lighting/knobs.h"

namespace gloam {

/// The displayed linear light of shaders/lighting/display/tone_curve.glsl in double precision. light: exposed, ≥ 0.
[[nodiscard]] dvec3 tone_mapped(ToneCurve curve, const dvec3& light);

/// The exposure that meter.comp computes for a frame's light, in double precision.
[[nodiscard]] double metered_exposure(const LinearPicture& lit);

/// The step of 8 bits, 0…255, to which shaders/lighting/dither_api.glsl rounds an encoded value at a pixel. encoded: in
/// 0…1. channel: 0…2.
[[nodiscard]] std::uint8_t dithered_step(double encoded, uvec2 pixel, std::uint32_t channel);

/// Reference picture of the chosen curve: exposure, curve and sRGB encoding of the frame's light in double precision,
/// rounded once, with the pattern of lighting.dither.
[[nodiscard]] Result<FramePictures> draw_tone_reference(const ReferenceInput& input);

}  // namespace gloam
