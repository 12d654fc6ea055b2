// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/emitter_samples.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "engine/math/low_discrepancy.h"

namespace gloam {
namespace {

/// Maps the unit square to the disc, preserving ratios of areas, and neighbourhood.
vec2 on_disc(double x, double y) {
  constexpr double kQuarter = 0.78539816339744830962;
  const double a = 2.0 * x - 1.0, b = 2.0 * y - 1.0;
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  if (radius == 0.0) return vec2(0.0f);
  const double angle = wide ? kQuarter * b / a : 2.0 * kQuarter - kQuarter * a / b;
  return {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))};
}

}  // namespace

EmitterSamples::EmitterSamples(std::uint32_t count) : count_(count) {
  GLOAM_ASSERT(count > 0, "a light is seen by at least one ray");
  points_.reserve(std::size_t{kPatterns} * count);
  for (std::uint32_t pattern = 0; pattern < kPatterns; ++pattern) {
    const std::uint32_t scramble_x = permuted(2 * pattern + 1), scramble_y = permuted(2 * pattern + 2);
    for (std::uint32_t i = 0; i < count; ++i)
      points_.push_back(
          on_disc(unit_fraction(reversed_bits(i) ^ scramble_x), unit_fraction(second_sobol(i) ^ scramble_y)));
  }
}

EmitterSamples::Pattern EmitterSamples::pattern(std::uint32_t pixel, std::uint32_t light) const {
  const std::uint32_t hash = permuted(permuted(pixel) + light);
  const double angle = 6.28318530717958647692 * unit_fraction(permuted(hash));
  return {.points = std::span(points_).subspan(std::size_t{hash % kPatterns} * count_, count_),
          .turn = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}};
}

}  // namespace gloam
