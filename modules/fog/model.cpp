// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/model.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"

namespace gloam {
namespace {

constexpr double kReferenceRadius = 6.0;  // standard deviations; the weight cut off is below 1e-8

/// One direction of the blur, for three doubles per texel. `lines`: number of lines, `line_step` texels apart; `count`:
/// texels of a line, `step` texels apart. `sigma`: in texels.
std::vector<double> blur_lines(const std::vector<double>& source, std::size_t lines, std::size_t line_step,
                               std::size_t count, std::size_t step, double sigma) {
  const auto taps = static_cast<long>(std::ceil(kReferenceRadius * sigma));
  std::vector<double> weights(static_cast<std::size_t>(2 * taps + 1));
  double total = 0.0;
  for (long i = -taps; i <= taps; ++i) {
    const double distance = static_cast<double>(i) / sigma;
    weights[static_cast<std::size_t>(i + taps)] = std::exp(-0.5 * distance * distance);
    total += weights[static_cast<std::size_t>(i + taps)];
  }
  std::vector<double> blurred(source.size());
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t at = 0; at < count; ++at) {
      double sum[3] = {0.0, 0.0, 0.0};
      for (long i = -taps; i <= taps; ++i) {
        const long other = std::clamp<long>(static_cast<long>(at) + i, 0, static_cast<long>(count) - 1);
        const double* texel = &source[3 * (line * line_step + static_cast<std::size_t>(other) * step)];
        for (int c = 0; c < 3; ++c) sum[c] += weights[static_cast<std::size_t>(i + taps)] * texel[c];
      }
      for (std::size_t c = 0; c < 3; ++c) blurred[3 * (line * line_step + at * step) + c] = sum[c] / total;
    }
  }
  return blurred;
}

}  // namespace

Fog find_fog(const World& world) {
  Fog found;
  world.view<const Fog>().each([&](const Fog& fog) {
    if (fog.density > 0.0f) found = fog;
  });
  return found;
}

GlowKernel glow_kernel(std::uint32_t height, std::uint32_t divisor, float radius) {
  GlowKernel kernel;
  kernel.sigma = std::max(kFogGlowSigma * static_cast<float>(height) / static_cast<float>(divisor), 1e-3f);
  kernel.taps = static_cast<int>(std::ceil(radius * kernel.sigma));
  return kernel;
}

std::vector<double> fog_reference(std::span<const float> lit, std::span<const double> distance_m, std::uint32_t width,
                                  std::uint32_t height, const Fog& fog, double most_light) {
  const std::size_t pixels = std::size_t{width} * height;
  GLOAM_ASSERT(lit.size() == 4 * pixels && distance_m.size() == pixels,
               "the picture and its distances have the stated size");
  std::vector<double> light(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) light[3 * i + c] = static_cast<double>(lit[4 * i + c]);
  const double sigma = std::max(static_cast<double>(kFogGlowSigma) * height, 1e-3);
  const std::vector<double> rows = blur_lines(light, height, width, width, 1, sigma);
  const std::vector<double> glow = blur_lines(rows, width, 1, height, width, sigma);
  std::vector<double> fogged(4 * pixels, 1.0);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double path = std::min(distance_m[i], static_cast<double>(fog.sky_distance_m));
    const double transmitted = std::exp(-static_cast<double>(fog.density) * path);
    for (std::size_t c = 0; c < 3; ++c) {
      const double scattered =
          static_cast<double>(fog.color[static_cast<int>(c)]) + static_cast<double>(kFogForwardShare) * glow[3 * i + c];
      fogged[4 * i + c] = transmitted * light[3 * i + c] + (1.0 - transmitted) * std::min(scattered, most_light);
    }
  }
  return fogged;
}

}  // namespace gloam
