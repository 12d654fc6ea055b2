// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/spread_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/glare/levels.h"

namespace gloam {
namespace {

/// Shares of a Gaussian in pixels at distances 0, 1, 2 … along an axis, up to the length of the axis.
std::vector<double> pixel_shares(double sigma_px, std::uint32_t length) {
  std::vector<double> shares(length);
  const double scale = 1.0 / (sigma_px * std::numbers::sqrt2);
  for (std::uint32_t i = 0; i < length; ++i)
    shares[i] = 0.5 * (std::erf((i + 0.5) * scale) - std::erf((i - 0.5) * scale));
  return shares;
}

/// Convolves each line. stride: between neighbours along a line; between: from a line to the next.
void convolve(const std::vector<dvec3>& from, std::vector<dvec3>& to, const std::vector<double>& shares,
              std::uint32_t lines, std::size_t between, std::size_t stride, JobExecutor& executor) {
  const std::size_t length = shares.size();
  // What lies beyond eight standard deviations is less than 1e-15 of the light.
  std::size_t reach = 1;
  while (reach < length && shares[reach] > 1e-16) ++reach;
  executor.parallel_for(lines, 1, [&](JobRange range) {
    for (std::size_t line = range.begin; line < range.end; ++line)
      for (std::size_t i = 0; i < length; ++i) {
        dvec3 sum(0.0);
        const std::size_t first = i + 1 > reach ? i + 1 - reach : 0, end = std::min(i + reach, length);
        for (std::size_t j = first; j < end; ++j)
          sum += shares[i > j ? i - j : j - i] * from[line * between + j * stride];
        to[line * between + i * stride] = sum;
      }
  });
}

}  // namespace

std::vector<dvec3> spread_light(const std::vector<vec4>& light, uvec2 size, JobExecutor& executor, double most) {
  std::vector<dvec3> source(light.size());
  for (std::size_t i = 0; i < light.size(); ++i)
    for (int c = 0; c < 3; ++c)
      source[i][c] = std::isnan(light[i][c]) ? 0.0 : std::clamp(static_cast<double>(light[i][c]), 0.0, most);
  std::vector<dvec3> spread(light.size(), dvec3(0.0)), rows(light.size()), both(light.size());
  for (const GlareGaussian& gaussian : glare_spread()) {
    const double sigma_px = gaussian.sigma * size.y;
    convolve(source, rows, pixel_shares(sigma_px, size.x), size.y, size.x, 1, executor);
    convolve(rows, both, pixel_shares(sigma_px, size.y), size.x, 1, size.x, executor);
    for (std::size_t i = 0; i < spread.size(); ++i) spread[i] += gaussian.share * both[i];
  }
  return spread;
}

}  // namespace gloam
