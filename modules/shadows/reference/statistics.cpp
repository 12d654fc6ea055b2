// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/statistics.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Whether traced visibility crosses one half between the pixel and one of its eight neighbours.
bool at_silhouette(const TracedVisibility& traced, std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
  const std::size_t first = layer * traced.pixels();
  const auto lit = [&](std::size_t pixel) { return traced.visibility[first + pixel] > 127; };
  const bool own = lit(std::size_t{y} * traced.width + x);
  const std::uint32_t left = x > 0 ? x - 1 : 0, right = std::min(x + 1, traced.width - 1);
  const std::uint32_t top = y > 0 ? y - 1 : 0, bottom = std::min(y + 1, traced.height - 1);
  for (std::uint32_t row = top; row <= bottom; ++row)
    for (std::uint32_t column = left; column <= right; ++column) {
      const std::size_t pixel = std::size_t{row} * traced.width + column;
      if (traced.is_judged(first + pixel) && lit(pixel) != own) return true;
    }
  return false;
}

}  // namespace

ShadowError& ShadowError::operator+=(const ShadowError& other) {
  pairs += other.pairs;
  penumbra_pairs += other.penumbra_pairs;
  difference += other.difference;
  penumbra_difference += other.penumbra_difference;
  off += other.off;
  faint_leaks += other.faint_leaks;
  wrong += other.wrong;
  acne += other.acne;
  leaks += other.leaks;
  unreached += other.unreached;
  return *this;
}

ShadowError compare_visibility(const TracedVisibility& traced, std::uint32_t layer, std::span<const float> drawn) {
  GLOAM_ASSERT(layer < traced.lights.size() && drawn.size() == traced.pixels(),
               "a layer that is there, a value a pixel");
  ShadowError error;
  for (std::uint32_t y = 0; y < traced.height; ++y) {
    for (std::uint32_t x = 0; x < traced.width; ++x) {
      const std::size_t pixel = std::size_t{y} * traced.width + x;
      const std::size_t at = layer * traced.pixels() + pixel;
      if (!traced.is_judged(at)) continue;
      if (drawn[pixel] < 0.0f) {
        ++error.unreached;
        continue;
      }
      const double right = traced.visibility[at] / 255.0;
      const double difference = std::abs(static_cast<double>(drawn[pixel]) - right);
      ++error.pairs;
      error.difference += difference;
      if (right >= 0.05 && right <= 0.95) {
        ++error.penumbra_pairs;
        error.penumbra_difference += difference;
      }
      if (!(difference > 0.1)) continue;
      ++error.off;
      if (at_silhouette(traced, layer, x, y)) continue;
      if (traced.visibility[at] == 0) ++error.faint_leaks;
      if (!(difference > 0.5)) continue;
      ++error.wrong;
      if (traced.visibility[at] == 255) ++error.acne;
      if (traced.visibility[at] == 0) ++error.leaks;
    }
  }
  return error;
}

}  // namespace gloam
