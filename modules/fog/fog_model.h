// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "modules/fog/components.h"

namespace gloam {

/// Share of the scattered light that keeps close to its direction and shows as glow.
inline constexpr float kFogForwardShare = 0.5f;
/// Path through the fog where there is no surface, metres: fog lies near the ground, so a sky is dimmed but not lost.
inline constexpr float kFogSkyDistance = 200.0f;
/// Standard deviation of the glow as a share of the picture's height.
inline constexpr float kFogGlowSigma = 0.02f;

/// Width of the blur in one image of it.
struct GlowKernel {
  float sigma = 1.0f;  ///< texels
  int taps = 1;        ///< on each side of the centre
};

/// The kernel for a picture of `height` pixels blurred at 1/divisor of its size and cut after `radius` standard
/// deviations.
[[nodiscard]] GlowKernel glow_kernel(std::uint32_t height, std::uint32_t divisor, float radius);

/// The whole effect by brute force in double: the full picture blurred with a kernel cut after 6 standard deviations,
/// then the fog of shaders/fog/apply.frag.glsl. `lit`: width · height · 4 floats before fog; `distance_m`: of each
/// pixel, infinite for sky. Returns what `lit` becomes, same layout, alpha 1.
[[nodiscard]] std::vector<double> fog_reference(std::span<const float> lit, std::span<const double> distance_m,
                                                std::uint32_t width, std::uint32_t height, const Fog& fog);

}  // namespace gloam
