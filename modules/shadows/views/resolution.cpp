// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/resolution.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

/// Difference in powers of two up to which a size is kept; at 0.5 the next size is equally near.
constexpr float kHoldOn = 0.7f;

}  // namespace

float pixels_across(const RenderView& view, const dvec3& center, float radius_m) {
  const auto longer = static_cast<float>(std::max(view.width, view.height));
  // Diameter in pixels of a radius of 1 at distance 1; orthographic: of a radius of 1 m.
  const float pixels_per_unit = view.clip_from_view[1][1] * static_cast<float>(view.height);
  if (view.clip_from_view[2][3] == 0.0f) return std::min(radius_m * pixels_per_unit, longer);
  const auto distance = static_cast<float>(glm::length(center - view.position));
  const float squared = distance * distance - radius_m * radius_m;
  if (!(squared > 0.0f)) return longer;
  return std::min(radius_m / std::sqrt(squared) * pixels_per_unit, longer);
}

float coverage(const RenderView& view, const dvec3& center, float radius_m) {
  const float pixels = pixels_across(view, center, radius_m);
  const float picture = static_cast<float>(view.width) * static_cast<float>(view.height);
  return std::min(1.0f, kPi * 0.25f * pixels * pixels / picture);
}

std::uint32_t wanted_size(float texels, std::uint32_t previous) {
  constexpr auto kLeast = static_cast<float>(GLOAM_SHADOW_SMALLEST_FACE);
  const float power = std::log2(std::min(std::max(kLeast, texels), static_cast<float>(kMostWantedFace)));
  if (previous != 0 && std::has_single_bit(previous)) {
    const auto before = static_cast<float>(std::bit_width(previous) - 1);
    if (std::abs(power - before) < kHoldOn) return std::min(previous, kMostWantedFace);
  }
  return 1u << static_cast<std::uint32_t>(std::lround(power));
}

std::uint32_t asked_size(std::uint32_t resolution) {
  return std::bit_ceil(std::clamp<std::uint32_t>(resolution, GLOAM_SHADOW_SMALLEST_FACE, kMostFace));
}

float rim_share(std::uint32_t size, float share) {
  constexpr float kLeastRim = 6.0f;  // half of eight texels, one for interpolation, one as a gutter
  const float half = 0.5f * static_cast<float>(size);
  const float rim = std::min(kLeastRim, 0.25f * half);
  return std::max(share, rim / (half - rim));
}

float brightness_of(const Light& light) {
  constexpr float kMost = 1e20f;  // products with coverage stay floats
  const float brightest = light.intensity * std::max({light.color.r, light.color.g, light.color.b, 0.0f});
  return brightest > 0.0f ? std::min(brightest, kMost) : 0.0f;
}

}  // namespace gloam
