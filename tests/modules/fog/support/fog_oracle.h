// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/packing.h"
#include "engine/math/types.h"
#include "modules/fog/components.h"

/// Two independent descriptions of the fog, in double. The oracle knows the physics only: it integrates the light along
/// each ray in small steps, and sums the glow over a square of pixels. The twin knows the passes: sizes, taps,
/// roundings and filtering of each.
namespace gloam::test {

inline constexpr double kMostLight = 65504.0;    // of rgba16f
inline constexpr double kForwardShare = 0.5;     // of the scattered light, that shows as glow
inline constexpr double kLongestPath_m = 200.0;  // the sky's
inline constexpr double kGlowSigma = 0.02;       // of the picture's height

/// Pictures of light in double, three numbers per pixel, rows from the top.
struct LightMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<dvec3> texels;

  /// The texel at these coordinates; beyond the border, the border texel.
  [[nodiscard]] const dvec3& at(long x, long y) const {
    const long inside_x = std::clamp<long>(x, 0, long{width} - 1), inside_y = std::clamp<long>(y, 0, long{height} - 1);
    return texels[static_cast<std::size_t>(inside_y) * width + static_cast<std::size_t>(inside_x)];
  }
};

[[nodiscard]] inline LightMap light_map(std::span<const float> rgba, std::uint32_t width, std::uint32_t height) {
  LightMap map{width, height, {}};
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) map.texels.emplace_back(rgba[i], rgba[i + 1], rgba[i + 2]);
  return map;
}

/// Light at the camera's end of a path through fog: dL/ds = density · (source − L), by Runge and Kutta's method in
/// steps of at most a 64th of the mean free path. At most the last 60 mean free paths are integrated: 10⁻²⁶ of the
/// light before them comes through.
[[nodiscard]] inline dvec3 integrate_fog(dvec3 light, const dvec3& source, double density, double path_m) {
  const double paths = std::min(density * std::min(path_m, kLongestPath_m), 60.0);
  const auto steps = static_cast<std::size_t>(std::ceil(64.0 * paths)) + 16;
  const double step = paths / static_cast<double>(steps);
  for (std::size_t i = 0; i < steps; ++i) {
    const dvec3 a = source - light;
    const dvec3 b = source - (light + 0.5 * step * a);
    const dvec3 c = source - (light + 0.5 * step * b);
    const dvec3 d = source - (light + step * c);
    light += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return light;
}

/// The glow at a pixel: the mean of the square of pixels within 7 standard deviations, weighted by the Gaussian.
[[nodiscard]] inline dvec3 glow_at(const LightMap& light, long x, long y) {
  const double sigma = kGlowSigma * light.height;
  const long reach = static_cast<long>(std::ceil(7.0 * sigma));
  dvec3 sum(0.0);
  double total = 0.0;
  for (long dy = -reach; dy <= reach; ++dy)
    for (long dx = -reach; dx <= reach; ++dx) {
      const double weight = std::exp(-0.5 * static_cast<double>(dx * dx + dy * dy) / (sigma * sigma));
      sum += weight * light.at(x + dx, y + dy);
      total += weight;
    }
  return sum / total;
}

[[nodiscard]] inline dvec3 fog_source(const Fog& fog, const dvec3& glow, double most_light = kMostLight) {
  return glm::min(dvec3(fog.color) + kForwardShare * glow, dvec3(most_light));
}

/// The picture with fog, by the oracle. distance_m: one per pixel, infinite for the sky. most_light: what the picture's
/// half floats hold.
[[nodiscard]] inline std::vector<dvec3> oracle_picture(const LightMap& light, std::span<const double> distance_m,
                                                       const Fog& fog, double most_light = kMostLight) {
  std::vector<dvec3> fogged;
  for (std::uint32_t y = 0; y < light.height; ++y)
    for (std::uint32_t x = 0; x < light.width; ++x) {
      const std::size_t i = std::size_t{y} * light.width + x;
      fogged.push_back(integrate_fog(light.texels[i], fog_source(fog, glow_at(light, x, y), most_light),
                                     static_cast<double>(fog.density), distance_m[i]));
    }
  return fogged;
}

[[nodiscard]] inline double as_half(double value) {
  return static_cast<double>(half_to_float(float_to_half(static_cast<float>(value))));
}
[[nodiscard]] inline dvec3 as_half(const dvec3& value) {
  return {as_half(value.r), as_half(value.g), as_half(value.b)};
}

/// The mean of each square of pixels, over the pixels that exist.
[[nodiscard]] inline LightMap reduced(const LightMap& light, std::uint32_t divisor) {
  LightMap small{(light.width + divisor - 1) / divisor, (light.height + divisor - 1) / divisor, {}};
  for (std::uint32_t y = 0; y < small.height; ++y)
    for (std::uint32_t x = 0; x < small.width; ++x) {
      dvec3 sum(0.0);
      double count = 0.0;
      for (std::uint32_t from_y = y * divisor; from_y < std::min((y + 1) * divisor, light.height); ++from_y)
        for (std::uint32_t from_x = x * divisor; from_x < std::min((x + 1) * divisor, light.width); ++from_x) {
          sum += light.at(from_x, from_y);
          count += 1.0;
        }
      small.texels.push_back(as_half(sum / count));
    }
  return small;
}

/// One direction of the blur, cut after `radius` standard deviations (rounded up to texels).
[[nodiscard]] inline LightMap blurred(const LightMap& light, long dx, long dy, double sigma, double radius) {
  const long taps = static_cast<long>(std::ceil(radius * sigma));
  LightMap result{light.width, light.height, {}};
  for (std::uint32_t y = 0; y < light.height; ++y)
    for (std::uint32_t x = 0; x < light.width; ++x) {
      dvec3 sum(0.0);
      double total = 0.0;
      for (long i = -taps; i <= taps; ++i) {
        const double away = static_cast<double>(i) / sigma;
        const double weight = std::exp(-0.5 * away * away);
        sum += weight * light.at(x + i * dx, y + i * dy);
        total += weight;
      }
      result.texels.push_back(as_half(sum / total));
    }
  return result;
}

/// A picture with fog as the passes draw it. slack: how far the filtering of the glow may be off at each pixel. Devices
/// place a sample in steps of 1/256 of a texel in each direction.
struct TwinPicture {
  std::vector<dvec3> light;
  std::vector<dvec3> slack;
};

/// The picture with fog as the passes draw it with these values of the knobs.
[[nodiscard]] inline TwinPicture twin_picture(const LightMap& light, std::span<const double> distance_m, const Fog& fog,
                                              std::uint32_t divisor, double radius) {
  const double sigma = kGlowSigma * light.height / divisor;
  const LightMap small = divisor > 1 ? reduced(light, divisor) : light;
  const LightMap glow = blurred(blurred(small, 1, 0, sigma, radius), 0, 1, sigma, radius);
  TwinPicture twin;
  for (std::uint32_t y = 0; y < light.height; ++y)
    for (std::uint32_t x = 0; x < light.width; ++x) {
      const double at_x = (x + 0.5) / divisor - 0.5, at_y = (y + 0.5) / divisor - 0.5;
      const long left = static_cast<long>(std::floor(at_x)), top = static_cast<long>(std::floor(at_y));
      const double right_share = at_x - static_cast<double>(left), low_share = at_y - static_cast<double>(top);
      const dvec3 &a = glow.at(left, top), &b = glow.at(left + 1, top);
      const dvec3 &c = glow.at(left, top + 1), &d = glow.at(left + 1, top + 1);
      const dvec3 seen = glm::mix(glm::mix(a, b, right_share), glm::mix(c, d, right_share), low_share);
      const dvec3 contrast = glm::max(glm::max(a, b), glm::max(c, d)) - glm::min(glm::min(a, b), glm::min(c, d));
      const std::size_t i = std::size_t{y} * light.width + x;
      const double kept = std::exp(-static_cast<double>(fog.density) * std::min(distance_m[i], kLongestPath_m));
      twin.light.push_back(kept * light.texels[i] + (1.0 - kept) * fog_source(fog, seen));
      twin.slack.push_back((1.0 - kept) * kForwardShare * contrast * (divisor > 1 ? 2.0 / 256.0 : 0.0));
    }
  return twin;
}

}  // namespace gloam::test
