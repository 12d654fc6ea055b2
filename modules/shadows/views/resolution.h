// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/render/view.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {

inline constexpr std::uint32_t kMostWantedFace = 2048;  ///< texels of a side; ShadowCaster::resolution may set more
inline constexpr std::uint32_t kMostFace = 4096;        ///< texels of a side; limit for all faces

/// Diameter in pixels of the sphere's image, at most the longer side of the picture; the latter when the camera is
/// inside the sphere. It does not depend on the camera's direction, so turning the camera changes no shadow map.
[[nodiscard]] float pixels_across(const RenderView& view, const dvec3& center, float radius_m);

/// Share of the picture that a sphere covers, 0 … 1. It does not depend on the camera's direction.
[[nodiscard]] float coverage(const RenderView& view, const dvec3& center, float radius_m);

/// The face size for an ideal number of texels: the nearest power of two, from the smallest face to kMostWantedFace.
/// `previous` (0: none) is kept until another size is clearly nearer, so that a face at the limit does not change size
/// every frame.
[[nodiscard]] std::uint32_t wanted_size(float texels, std::uint32_t previous);

/// Share of the available texels that maps may fill. Below it, squares with power-of-two sides always find a place.
inline constexpr double kMostFilled = 0.9;
/// The same limit for raising the density. It is lower, so that lights that enter and leave the view do not resize the
/// maps of others.
inline constexpr double kMostFilledHigher = 0.6;

/// The density, in texels per pixel side, for maps that share room_texels: the highest of `most`, `most` / 2^¼, `most`
/// / 2^½ … `most` / 2^6 at which they fit. The lowest of these if they fit at none. `previous` (0: none) is kept until
/// the maps no longer fit, or until they fill at most kMostFilledHigher at a higher density. filled(density): texels
/// that all maps take at that density.
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

/// The face size for ShadowCaster::resolution > 0: the next power of two, from the smallest face to kMostFace.
[[nodiscard]] std::uint32_t asked_size(std::uint32_t resolution);

/// Width of a face's rim as a share of the half extent inside it: `share`, but on small faces enough for the smallest
/// kernel and a gutter (6 texels, at most an eighth of the face's side). size: texels of the face's side.
[[nodiscard]] float rim_share(std::uint32_t size, float share);

/// Candela or lux of the brightest channel, at most 1e20; 0 for a light that gives none, or whose value is NaN.
[[nodiscard]] float brightness_of(const Light& light);

}  // namespace gloam
