// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "modules/fog/components.h"

namespace gloam {

/// Share of the scattered light that nearly keeps its direction and shows as glow.
inline constexpr float kFogForwardShare = 0.5f;
/// Standard deviation of the glow as a share of the picture's height.
inline constexpr float kFogGlowSigma = 0.02f;

/// The scene's fog; density 0 if it has none.
[[nodiscard]] Fog find_fog(const World& world);

/// Gaussian of the blur, in texels of the image that is blurred.
struct GlowKernel {
  float sigma = 1.0f;  ///< texels
  int taps = 1;        ///< on each side of the centre
};

/// The kernel for a picture of `height` pixels, blurred at 1/divisor of its size. The Gaussian is cut at `radius`
/// standard deviations.
[[nodiscard]] GlowKernel glow_kernel(std::uint32_t height, std::uint32_t divisor, float radius);

/// The whole effect in double: fog as in shaders/fog/apply.frag.glsl, with the glow summed over all pairs of pixels
/// within 6 standard deviations. `lit`: width · height · 4 floats before fog; `distance_m`: length of the path through
/// the fog, one per pixel, infinite for sky. most_light: of scattered light, as the frame's image can hold it. Returns
/// the picture with fog, same layout, alpha 1.
[[nodiscard]] std::vector<double> fog_reference(std::span<const float> lit, std::span<const double> distance_m,
                                                std::uint32_t width, std::uint32_t height, const Fog& fog,
                                                double most_light = 65504.0);

}  // namespace gloam
