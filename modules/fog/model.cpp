// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/model.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"

namespace gloam {
namespace {

constexpr double kReferenceRadius = 6.0;  // standard deviations; the weight cut off is below 1e-8

/// Weights of the Gaussian at 0, 1 … texels from its middle, as far as kReferenceRadius.
std::vector<double> gaussian(double sigma) {
  std::vector<double> weights;
  for (long i = 0; i <= static_cast<long>(std::ceil(kReferenceRadius * sigma)); ++i) {
    const double away = static_cast<double>(i) / sigma;
    weights.push_back(std::exp(-0.5 * away * away));
  }
  return weights;
}

/// A picture whose rows reach `margin` texels beyond both borders, where the border texel repeats.
struct WideRows {
  std::size_t margin, pitch;
  std::vector<double> channels[3], shares;  ///< light, and the share of it that fog scatters

  WideRows(std::span<const float> lit, std::span<const double> scattered, std::size_t width, std::size_t height,
           std::size_t margin_texels)
      : margin(margin_texels), pitch(width + 2 * margin_texels) {
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < pitch; ++x) {
        const std::size_t at = y * width + std::min(std::max(x, margin) - margin, width - 1);
        for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(static_cast<double>(lit[4 * at + c]));
        shares.push_back(scattered[at]);
      }
  }
};

/// Adds to `sums` (three per texel of a row) a row of light times the lesser of both shares, `shift` texels aside.
void add_row(const WideRows& from, std::size_t row, std::size_t shift, double weight, std::span<const double> own,
             std::vector<double> (&sums)[3]) {
  const double* shares = &from.shares[row * from.pitch + shift];
  for (std::size_t c = 0; c < 3; ++c) {
    const double* light = &from.channels[c][row * from.pitch + shift];
    double* sum = sums[c].data();
    for (std::size_t x = 0; x < own.size(); ++x) sum[x] += weight * light[x] * std::min(shares[x], own[x]);
  }
}

/// The glow of each pixel, three numbers: of all pixels around it, the light that fog scatters before it is as near as
/// the pixel's surface. Every pair of pixels is taken by itself.
std::vector<double> glow_of_pairs(std::span<const float> lit, std::span<const double> scattered, std::size_t width,
                                  std::size_t height, double sigma) {
  const std::vector<double> weights = gaussian(sigma);
  const long reach = static_cast<long>(weights.size()) - 1;
  const WideRows rows(lit, scattered, width, height, static_cast<std::size_t>(reach));
  double total = weights[0];
  for (std::size_t i = 1; i < weights.size(); ++i) total += 2.0 * weights[i];
  std::vector<double> glow(3 * width * height);
  for (std::size_t y = 0; y < height; ++y) {
    std::vector<double> sums[3];
    for (std::vector<double>& sum : sums) sum.assign(width, 0.0);
    for (long dy = -reach; dy <= reach; ++dy) {
      const long row = std::clamp<long>(static_cast<long>(y) + dy, 0, static_cast<long>(height) - 1);
      for (long dx = -reach; dx <= reach; ++dx) {
        const double weight =
            weights[static_cast<std::size_t>(std::abs(dx))] * weights[static_cast<std::size_t>(std::abs(dy))];
        add_row(rows, static_cast<std::size_t>(row), static_cast<std::size_t>(dx + reach), weight / (total * total),
                scattered.subspan(y * width, width), sums);
      }
    }
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) glow[3 * (y * width + x) + c] = sums[c][x];
  }
  return glow;
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
  std::vector<double> scattered(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double path = std::min(distance_m[i], static_cast<double>(fog.sky_distance_m));
    scattered[i] = -std::expm1(-static_cast<double>(fog.density) * path);
  }
  const double sigma = std::max(static_cast<double>(kFogGlowSigma) * height, 1e-3);
  const std::vector<double> glow = glow_of_pairs(lit, scattered, width, height, sigma);
  std::vector<double> fogged(4 * pixels, 1.0);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double added = scattered[i] * static_cast<double>(fog.color[static_cast<int>(c)]) +
                           static_cast<double>(kFogForwardShare) * glow[3 * i + c];
      fogged[4 * i + c] =
          (1.0 - scattered[i]) * static_cast<double>(lit[4 * i + c]) + std::min(added, scattered[i] * most_light);
    }
  return fogged;
}

}  // namespace gloam
