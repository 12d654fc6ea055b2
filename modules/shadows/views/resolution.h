// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/render/view.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {

inline constexpr std::uint32_t kMostWantedFace = 2048;  ///< texels, where no ShadowCaster asks for more
inline constexpr std::uint32_t kMostFace = 4096;        ///< texels

/// Pixels that something `radius_m` wide to each side covers across where the sphere is, whichever way the camera
/// looks: turning it changes no shadow map. From within the sphere, and never more than, the longer side of the
/// picture.
[[nodiscard]] float pixels_across(const RenderView& view, const dvec3& center, float radius_m);

/// Share of the picture that a sphere covers, 0…1, whichever way the camera looks.
[[nodiscard]] float coverage(const RenderView& view, const dvec3& center, float radius_m);

/// Texels of a face from how many would be right: the nearest power of two, from the smallest face to kMostWantedFace.
/// `previous` (0: none) stays until another is clearly nearer, so that a face at the limit does not change every frame.
[[nodiscard]] std::uint32_t wanted_size(float texels, std::uint32_t previous);

/// Share of the room that maps may fill. Squares whose sides are powers of two then always find a place.
inline constexpr double kMostFilled = 0.9;
/// The same at the next higher density, for going up to it: lights that come into view and leave it change no maps of
/// others.
inline constexpr double kMostFilledHigher = 0.6;

/// Texels to a pixel's side for maps that share a room: the highest of `most`, `most` / 2^¼, `most` / 2^½ … `most` /
/// 2^6 at which they fit. `previous` (0: none) stays until they do not fit or fit well at a higher one.
/// `filled(density)`: texels that maps take at it.
template <class Filled>
[[nodiscard]] float fitting_density(float most, float previous, double room_texels, const Filled& filled) {
  constexpr int kSteps = 24;
  int step = 0;
  for (; step < kSteps; ++step) {
    const float density = most * std::exp2(-0.25f * static_cast<float>(step));
    const bool higher = previous > 0.0f && density > previous * 1.01f;
    if (filled(density) <= room_texels * (higher ? kMostFilledHigher : kMostFilled)) return density;
  }
  return most * std::exp2(-0.25f * static_cast<float>(step));
}

/// Texels of a face when ShadowCaster::resolution, above 0, says how many: the next power of two, at most kMostFace.
[[nodiscard]] std::uint32_t asked_size(std::uint32_t resolution);

/// Candela or lux of the brightest channel; 0 for a light that gives none or is not finite.
[[nodiscard]] float brightness_of(const Light& light);

}  // namespace gloam
