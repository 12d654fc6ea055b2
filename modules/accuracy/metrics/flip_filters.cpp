// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace gloam::flip {
namespace {

constexpr double kPiSquare = std::numbers::pi * std::numbers::pi;

/// a · sqrt(π / b) · exp(−π² r² / b), r in degrees: table 1 of the paper.
struct Gaussian {
  double a;
  double b;
};
constexpr Gaussian kLuminance[] = {{1.0, 0.0047}};
constexpr Gaussian kRedGreen[] = {{1.0, 0.0053}};
constexpr Gaussian kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestB = 0.04;  // greatest b: all channels use its radius

constexpr double kFeatureWidth = 0.082;  // degrees

std::span<const Gaussian> gaussians_of(Opponent channel) {
  switch (channel) {
    case Opponent::luminance:
      return kLuminance;
    case Opponent::red_green:
      return kRedGreen;
    case Opponent::blue_yellow:
      return kBlueYellow;
  }
  return {};
}

template <class Weight>
Kernel make_kernel(int radius, Weight&& weight) {
  Kernel kernel{radius, {}};
  for (int x = -radius; x <= radius; ++x) kernel.weights.push_back(weight(static_cast<double>(x)));
  return kernel;
}

double sum_of(const Kernel& kernel) {
  double sum = 0.0;
  for (const double weight : kernel.weights) sum += weight;
  return sum;
}

void scale_to_sum_one(Kernel& kernel) {
  const double sum = sum_of(kernel);
  for (double& weight : kernel.weights) weight /= sum;
}

void scale_each_sign_to_one(Kernel& kernel) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : kernel.weights) (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel.weights) weight /= weight > 0.0 ? positive : negative;
}

/// to[i] += weight · from[i]
void add_scaled(std::span<double> to, const double* from, double weight) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * from[i];
}

}  // namespace

FlipPlane filter_rows(const FlipPlane& plane, const Kernel& kernel) {
  const auto radius = static_cast<std::size_t>(kernel.radius);
  const std::size_t width = plane.width;
  FlipPlane result{plane.width, plane.height, std::vector<double>(plane.values.size())};
  std::vector<double> padded(width + 2 * radius);
  for (std::size_t y = 0; y < plane.height; ++y) {
    const double* const row = plane.values.data() + y * width;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill(padded.end() - static_cast<std::ptrdiff_t>(radius), padded.end(), row[width - 1]);
    const std::span<double> out(result.values.data() + y * width, width);
    for (std::size_t tap = 0; tap < kernel.weights.size(); ++tap)
      add_scaled(out, padded.data() + tap, kernel.weights[tap]);
  }
  return result;
}

FlipPlane filter_columns(const FlipPlane& plane, const Kernel& kernel) {
  const std::size_t width = plane.width;
  const int last = static_cast<int>(plane.height) - 1;
  FlipPlane result{plane.width, plane.height, std::vector<double>(plane.values.size())};
  for (int y = 0; y <= last; ++y) {
    const std::span<double> out(result.values.data() + static_cast<std::size_t>(y) * width, width);
    for (int offset = -kernel.radius; offset <= kernel.radius; ++offset) {
      const auto from = static_cast<std::size_t>(std::clamp(y + offset, 0, last));
      const int tap = offset + kernel.radius;
      add_scaled(out, plane.values.data() + from * width, kernel.weights[static_cast<std::size_t>(tap)]);
    }
  }
  return result;
}

SensitivityFilter sensitivity_filter(Opponent channel, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPiSquare)) * pixels_per_degree));
  SensitivityFilter filter;
  double total = 0.0;
  for (const Gaussian& gaussian : gaussians_of(channel)) {
    Kernel kernel = make_kernel(radius, [&](double x) {
      const double degrees = x / pixels_per_degree;
      return std::exp(-kPiSquare * degrees * degrees / gaussian.b);
    });
    const double sum = sum_of(kernel);
    const double share = gaussian.a * std::sqrt(std::numbers::pi / gaussian.b) * sum * sum;
    scale_to_sum_one(kernel);
    total += share;
    filter.parts.push_back({share, std::move(kernel)});
  }
  for (SensitivityFilter::Part& part : filter.parts) part.share /= total;
  return filter;
}

FlipPlane apply(const SensitivityFilter& filter, const FlipPlane& plane) {
  FlipPlane sum{plane.width, plane.height, std::vector<double>(plane.values.size())};
  for (const SensitivityFilter::Part& part : filter.parts) {
    const FlipPlane filtered = filter_columns(filter_rows(plane, part.kernel), part.kernel);
    add_scaled(sum.values, filtered.values.data(), part.share);
  }
  return sum;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const double square = deviation * deviation;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto gaussian = [square](double x) { return std::exp(-x * x / (2.0 * square)); };
  FeatureKernels kernels = {
      .gaussian = make_kernel(radius, gaussian),
      .edge = make_kernel(radius, [&](double x) { return -x * gaussian(x); }),
      .point = make_kernel(radius, [&](double x) { return (x * x / square - 1.0) * gaussian(x); })};
  scale_to_sum_one(kernels.gaussian);
  scale_each_sign_to_one(kernels.edge);
  scale_each_sign_to_one(kernels.point);
  return kernels;
}

}  // namespace gloam::flip
