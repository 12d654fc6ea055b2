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

/// The glow at a pixel: the mean of the square of pixels within 7 standard deviations, weighted by the Gaussian, of the
/// light that is scattered before it is as near as the pixel's surface. scattered: share of a pixel's light, one texel
/// each.
[[nodiscard]] inline dvec3 glow_at(const LightMap& light, const LightMap& scattered, long x, long y) {
  const double sigma = kGlowSigma * light.height;
  const long reach = static_cast<long>(std::ceil(7.0 * sigma));
  dvec3 sum(0.0);
  double total = 0.0;
  for (long dy = -reach; dy <= reach; ++dy)
    for (long dx = -reach; dx <= reach; ++dx) {
      const double weight = std::exp(-0.5 * static_cast<double>(dx * dx + dy * dy) / (sigma * sigma));
      sum += weight * light.at(x + dx, y + dy) * glm::min(scattered.at(x + dx, y + dy), scattered.at(x, y));
      total += weight;
    }
  return sum / total;
}

/// The shares of light that fog scatters on paths of these lengths: what arrives of a source of 1 in all of the fog.
[[nodiscard]] inline LightMap scattered_shares(const LightMap& light, std::span<const double> distance_m,
                                               const Fog& fog) {
  LightMap shares{light.width, light.height, {}};
  for (const double path_m : distance_m)
    shares.texels.push_back(integrate_fog(dvec3(0.0), dvec3(1.0), static_cast<double>(fog.density), path_m));
  return shares;
}

/// What fog adds to a pixel's light.
[[nodiscard]] inline dvec3 added_light(const Fog& fog, const dvec3& scattered, const dvec3& glow,
                                       double most_light = kMostLight) {
  return glm::min(scattered * dvec3(fog.color) + kForwardShare * glow, scattered * most_light);
}

/// The picture with fog, by the oracle. distance_m: one per pixel, infinite for the sky. most_light: what the picture's
/// half floats hold.
[[nodiscard]] inline std::vector<dvec3> oracle_picture(const LightMap& light, std::span<const double> distance_m,
                                                       const Fog& fog, double most_light = kMostLight) {
  const LightMap scattered = scattered_shares(light, distance_m, fog);
  std::vector<dvec3> fogged;
  for (std::uint32_t y = 0; y < light.height; ++y)
    for (std::uint32_t x = 0; x < light.width; ++x) {
      const std::size_t i = std::size_t{y} * light.width + x;
      fogged.push_back(integrate_fog(light.texels[i], dvec3(0.0), static_cast<double>(fog.density), distance_m[i]) +
                       added_light(fog, scattered.texels[i], glow_at(light, scattered, x, y), most_light));
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

/// A filtered texel, and the contrast of the four texels that it is made of.
struct Filtered {
  dvec3 light;
  dvec3 contrast;
};

[[nodiscard]] inline Filtered filtered(const LightMap& small, std::uint32_t x, std::uint32_t y, std::uint32_t divisor) {
  const double at_x = (x + 0.5) / divisor - 0.5, at_y = (y + 0.5) / divisor - 0.5;
  const long left = static_cast<long>(std::floor(at_x)), top = static_cast<long>(std::floor(at_y));
  const double right_share = at_x - static_cast<double>(left), low_share = at_y - static_cast<double>(top);
  const dvec3 &a = small.at(left, top), &b = small.at(left + 1, top);
  const dvec3 &c = small.at(left, top + 1), &d = small.at(left + 1, top + 1);
  return {glm::mix(glm::mix(a, b, right_share), glm::mix(c, d, right_share), low_share),
          glm::max(glm::max(a, b), glm::max(c, d)) - glm::min(glm::min(a, b), glm::min(c, d))};
}

/// A picture with fog as the passes draw it. slack: how far the filtering of the glow may be off at each pixel. Devices
/// place a sample in steps of 1/256 of a texel in each direction.
struct TwinPicture {
  std::vector<dvec3> light;
  std::vector<dvec3> slack;
};

/// The picture with fog as the passes draw it with these values of the knobs. Its glow is at least the oracle's: of all
/// neighbours together it takes the lesser of what they lose and of what they would lose at the pixel's distance.
[[nodiscard]] inline TwinPicture twin_picture(const LightMap& light, std::span<const double> distance_m, const Fog& fog,
                                              std::uint32_t divisor, double radius, double most_light = kMostLight) {
  const double sigma = kGlowSigma * light.height / divisor;
  LightMap lost{light.width, light.height, {}}, whole = lost;  // light that is scattered, mean of the light's channels
  std::vector<double> scattered;
  for (std::size_t i = 0; i < light.texels.size(); ++i) {
    scattered.push_back(-std::expm1(-static_cast<double>(fog.density) * std::min(distance_m[i], kLongestPath_m)));
    lost.texels.push_back(light.texels[i] * scattered[i]);
    whole.texels.emplace_back((light.texels[i].r + light.texels[i].g + light.texels[i].b) / 3.0);
  }
  const auto spread = [&](const LightMap& map) {
    return blurred(blurred(reduced(map, divisor), 1, 0, sigma, radius), 0, 1, sigma, radius);
  };
  const LightMap glow = spread(lost), all = spread(whole);
  TwinPicture twin;
  for (std::uint32_t y = 0; y < light.height; ++y)
    for (std::uint32_t x = 0; x < light.width; ++x) {
      const Filtered seen = filtered(glow, x, y, divisor), of_all = filtered(all, x, y, divisor);
      const std::size_t i = std::size_t{y} * light.width + x;
      const double mean = (seen.light.r + seen.light.g + seen.light.b) / 3.0;
      const double nearer = std::min(scattered[i] * of_all.light.r * (1.0 + 1.0 / 256.0), mean) / std::max(mean, 1e-30);
      const dvec3 added = added_light(fog, dvec3(scattered[i]), nearer * seen.light, most_light);
      twin.light.push_back((1.0 - scattered[i]) * light.texels[i] + added);
      const dvec3 of_ratio = scattered[i] * of_all.contrast.r * seen.light / std::max(mean, 1e-30);
      twin.slack.push_back(kForwardShare * (2.0 * seen.contrast + of_ratio) * (divisor > 1 ? 2.0 / 256.0 : 0.0));
    }
  return twin;
}

}  // namespace gloam::test
