// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/view.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

namespace gloam {

inline constexpr std::uint32_t kMostWantedFace = 2048;  ///< texels, where no ShadowCaster asks for more
inline constexpr std::uint32_t kMostFace = 4096;        ///< texels

/// Pixels that something `radius_m` wide to each side covers across where the sphere is, whichever way the camera looks: turning it changes
/// no shadow map. From within the sphere, and never more than, the longer side of the picture.
[[nodiscard]] float pixels_across(const RenderView& view, const dvec3& center, float radius_m);

/// Share of the picture that a sphere covers, 0…1, whichever way the camera looks.
[[nodiscard]] float coverage(const RenderView& view, const dvec3& center, float radius_m);

/// Texels of a face from the pixels that one texel each would be right for: the nearest power of two, from the smallest face to
/// kMostWantedFace. `previous` (0: none) stays until another is clearly nearer, so that a face at the limit does not change every frame.
[[nodiscard]] std::uint32_t wanted_size(float pixels, std::uint32_t previous);

/// Texels of a face when ShadowCaster::resolution, above 0, says how many: the next power of two, at most kMostFace.
[[nodiscard]] std::uint32_t asked_size(std::uint32_t resolution);

/// Candela or lux of the brightest channel; 0 for a light that gives none or is not finite.
[[nodiscard]] float brightness_of(const Light& light);

}  // namespace gloam
