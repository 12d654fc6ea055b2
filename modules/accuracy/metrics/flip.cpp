// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/assert.h"
#include "engine/math/srgb.h"
#include "modules/accuracy/metrics/flip_color.h"
#include "modules/accuracy/metrics/flip_filters.h"

namespace gloam {
namespace {

using namespace flip;

constexpr double kColorExponent = 0.7;    // q_c
constexpr double kCompressFrom = 0.4;     // p_c: differences up to this share of the largest are stretched …
constexpr double kCompressTo = 0.95;      // p_t: … to this share of the range
constexpr double kFeatureExponent = 0.5;  // q_f

struct Opponents {
  std::array<FlipPlane, 3> planes;
};

Opponents opponents_of(const EncodedPixels& picture) {
  std::array<double, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<double>(i) / 255.0);
  Opponents result;
  for (FlipPlane& plane : result.planes) plane = {picture.width, picture.height, std::vector<double>(picture.count())};
  for (std::size_t i = 0; i < picture.count(); ++i) {
    const std::uint8_t* const pixel = picture.rgba.data() + i * 4;
    const Color color = ycxcz_from_linear({linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]});
    for (std::size_t channel = 0; channel < 3; ++channel) result.planes[channel].values[i] = color[channel];
  }
  return result;
}

/// Gradient magnitude of one feature: `kernel` across, the Gaussian along.
std::vector<float> feature_strength(const FlipPlane& luminance, const FlipPlane& smooth_rows, const Kernel& kernel,
                                    const Kernel& gaussian) {
  const FlipPlane across_x = filter_columns(filter_rows(luminance, kernel), gaussian);
  const FlipPlane across_y = filter_columns(smooth_rows, kernel);
  std::vector<float> strength(luminance.values.size());
  for (std::size_t i = 0; i < strength.size(); ++i) {
    const double x = across_x.values[i];
    const double y = across_y.values[i];
    strength[i] = static_cast<float>(std::sqrt(x * x + y * y));
  }
  return strength;
}

void add_features(FlipFeatures& features, FlipPlane luminance) {
  for (double& value : luminance.values) value = (value + 16.0) / 116.0;
  const FeatureKernels kernels = feature_kernels(features.pixels_per_degree);
  const FlipPlane smooth_rows = filter_rows(luminance, kernels.gaussian);
  features.edges = feature_strength(luminance, smooth_rows, kernels.edge, kernels.gaussian);
  features.points = feature_strength(luminance, smooth_rows, kernels.point, kernels.gaussian);
}

void add_colors(FlipFeatures& features, Opponents opponents) {
  constexpr Opponent kChannels[] = {Opponent::luminance, Opponent::red_green, Opponent::blue_yellow};
  for (std::size_t i = 0; i < 3; ++i)
    opponents.planes[i] = apply(sensitivity_filter(kChannels[i], features.pixels_per_degree), opponents.planes[i]);
  const auto& planes = opponents.planes;
  const std::size_t count = planes[0].values.size();
  for (std::vector<float>* values : {&features.lightness, &features.a, &features.b}) values->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Color rgb = linear_from_ycxcz({planes[0].values[i], planes[1].values[i], planes[2].values[i]});
    for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
    const Color lab = hunt_lab_from_linear(rgb);
    features.lightness[i] = static_cast<float>(lab[0]);
    features.a[i] = static_cast<float>(lab[1]);
    features.b[i] = static_cast<float>(lab[2]);
  }
}

/// Stretches small colour differences over most of 0…1 (§4.1.3). `largest`: the largest difference of any two colours.
double stretched(double difference, double largest) {
  const double knee = kCompressFrom * largest;
  if (difference < knee) return difference * kCompressTo / knee;
  return kCompressTo + (difference - knee) / (largest - knee) * (1.0 - kCompressTo);
}

}  // namespace

FlipFeatures flip_features(const EncodedPixels& picture, double pixels_per_degree) {
  GLOAM_ASSERT(picture.whole(), "a picture has four numbers a pixel and at least one pixel");
  GLOAM_ASSERT(pixels_per_degree > 0.0 && pixels_per_degree <= 1000.0, "pixels per degree lie above 0 and up to 1000");
  FlipFeatures features = {.width = picture.width, .height = picture.height, .pixels_per_degree = pixels_per_degree};
  Opponents opponents = opponents_of(picture);
  add_features(features, opponents.planes[0]);
  add_colors(features, std::move(opponents));
  return features;
}

std::vector<float> flip_error_map(const FlipFeatures& reference, const FlipFeatures& test) {
  GLOAM_ASSERT(reference.width == test.width && reference.height == test.height,
               "pictures of different sizes cannot be compared");
  GLOAM_ASSERT(reference.pixels_per_degree == test.pixels_per_degree,
               "pictures are compared under one viewing condition");
  const double largest =
      std::pow(hyab(hunt_lab_from_linear({0.0, 1.0, 0.0}), hunt_lab_from_linear({0.0, 0.0, 1.0})), kColorExponent);
  const auto distance = [](float a, float b) { return std::abs(static_cast<double>(a) - static_cast<double>(b)); };
  std::vector<float> errors(reference.lightness.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double difference =
        hyab({reference.lightness[i], reference.a[i], reference.b[i]}, {test.lightness[i], test.a[i], test.b[i]});
    const double color = stretched(std::pow(difference, kColorExponent), largest);
    const double features =
        std::max(distance(reference.edges[i], test.edges[i]), distance(reference.points[i], test.points[i]));
    const double feature = std::clamp(std::pow(features / std::numbers::sqrt2, kFeatureExponent), 0.0, 1.0);
    errors[i] = static_cast<float>(std::pow(color, 1.0 - feature));
  }
  return errors;
}

}  // namespace gloam
