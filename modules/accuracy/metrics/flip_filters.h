// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace gloam::flip {

struct FlipPlane {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<double> values;
};

/// Weights of the offsets −radius…radius of a one-dimensional filter.
struct Kernel {
  int radius = 0;
  std::vector<double> weights;
};

/// Correlation along rows or columns. Beyond the border the border pixel repeats.
[[nodiscard]] FlipPlane filter_rows(const FlipPlane& plane, const Kernel& kernel);
[[nodiscard]] FlipPlane filter_columns(const FlipPlane& plane, const Kernel& kernel);

/// A contrast sensitivity as a weighted sum of two-dimensional Gaussians. Each is separable: its kernel along rows
/// times the same kernel along columns. The weights of a kernel sum to 1, and so do the shares.
struct SensitivityFilter {
  struct Part {
    double share = 0.0;
    Kernel kernel;
  };
  std::vector<Part> parts;
};

enum class Opponent { luminance, red_green, blue_yellow };
[[nodiscard]] SensitivityFilter sensitivity_filter(Opponent channel, double pixels_per_degree);
[[nodiscard]] FlipPlane apply(const SensitivityFilter& filter, const FlipPlane& plane);

/// Kernels that detect features: a Gaussian and its first and second derivative. In a derivative, the positive weights
/// sum to 1 and the negative ones to −1.
struct FeatureKernels {
  Kernel gaussian;
  Kernel edge;
  Kernel point;
};
[[nodiscard]] FeatureKernels feature_kernels(double pixels_per_degree);

}  // namespace gloam::flip
