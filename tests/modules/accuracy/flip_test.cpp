// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/flip.h"
#include "engine/math/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/scene/decoding/image_file.h"
#include "modules/accuracy/metrics/flip_color.h"
#include "modules/accuracy/metrics/statistics.h"
#include "tests/modules/accuracy/test_pictures.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using flip::Color;
using test::EncodedPicture;
using test::random_encoded;

const std::string kFolder = GLOAM_SOURCE_DIR "/tests/modules/accuracy/flip/";

std::string text_of(const std::string& name) {
  std::ifstream file(kFolder + name, std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

EncodedPicture picture_of(const std::string& name) {
  const std::string bytes = text_of(name);
  const auto image = decode_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  EXPECT_TRUE(image.ok()) << name;
  return {image->width, image->height, image->rgba};
}

ErrorStatistics flip_of(const EncodedPicture& reference, const EncodedPicture& test,
                        double ppd = kFlipPixelsPerDegree) {
  return statistics_of(flip_error_map(flip_features(reference.pixels(), ppd), flip_features(test.pixels(), ppd)));
}

TEST(flip, says_of_seven_pairs_what_the_reference_implementation_says) {
  const auto expected = nlohmann::json::parse(text_of("expected.json"));
  const double tolerance = expected["tolerance"];
  const double ppd = expected["pixels_per_degree"];
  EXPECT_NEAR(ppd, kFlipPixelsPerDegree, 1e-4);
  ASSERT_EQ(expected["pairs"].size(), 7u);
  for (const auto& pair : expected["pairs"]) {
    SCOPED_TRACE(pair["test"].get<std::string>());
    const ErrorStatistics flip = flip_of(picture_of(pair["reference"]), picture_of(pair["test"]));
    EXPECT_NEAR(flip.mean, pair["mean"].get<double>(), tolerance);
    EXPECT_NEAR(flip.min, pair["min"].get<double>(), tolerance);
    EXPECT_NEAR(flip.max, pair["max"].get<double>(), tolerance);
  }
}

// ---- The formulas exactly as the paper prints them: two-dimensional filters, one pixel at a time. ----

struct Weights {
  int radius = 0;
  std::map<std::pair<int, int>, double> at;
};

template <class F>
Weights weights_of(int radius, F&& weight) {
  Weights weights{radius, {}};
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) weights.at[{x, y}] = weight(x, y);
  }
  return weights;
}

double filtered(const std::vector<Color>& image, const EncodedPicture& picture, int x, int y, std::size_t channel,
                const Weights& w) {
  double sum = 0.0;
  for (const auto& [offset, weight] : w.at) {
    const int from_x = std::clamp(x + offset.first, 0, static_cast<int>(picture.width) - 1);
    const int from_y = std::clamp(y + offset.second, 0, static_cast<int>(picture.height) - 1);
    sum += weight * image[static_cast<std::size_t>(from_y) * picture.width + static_cast<std::size_t>(from_x)][channel];
  }
  return sum;
}

Weights sensitivity(double a1, double b1, double a2, double b2, double ppd) {
  const double pi = std::acos(-1.0);
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * ppd));
  Weights weights = weights_of(radius, [&](int x, int y) {
    const double d2 = (x * x + y * y) / (ppd * ppd);
    return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) +
           a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2);
  });
  double sum = 0.0;
  for (const auto& [offset, weight] : weights.at) sum += weight;
  for (auto& [offset, weight] : weights.at) weight /= sum;
  return weights;
}

Weights feature(bool points, bool along_y, double ppd) {
  const double deviation = 0.5 * 0.082 * ppd;
  Weights weights = weights_of(static_cast<int>(std::ceil(3.0 * deviation)), [&](int x, int y) {
    const double g = std::exp(-(x * x + y * y) / (2.0 * deviation * deviation));
    const double u = along_y ? y : x;
    return points ? (u * u / (deviation * deviation) - 1.0) * g : -u * g;
  });
  double positive = 0.0;
  double negative = 0.0;
  for (const auto& [offset, weight] : weights.at) (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (auto& [offset, weight] : weights.at) weight /= weight > 0.0 ? positive : negative;
  return weights;
}

struct Seen {
  std::vector<Color> lab;
  std::vector<double> edges;
  std::vector<double> points;
};

Seen brute_features(const EncodedPicture& picture, double ppd) {
  std::vector<Color> image;
  for (std::size_t i = 0; i < picture.pixels().count(); ++i) {
    Color rgb;
    for (std::size_t channel = 0; channel < 3; ++channel)
      rgb[channel] = srgb_to_linear(picture.rgba[i * 4 + channel] / 255.0);
    image.push_back(flip::ycxcz_from_linear(rgb));
  }
  const Weights filters[] = {sensitivity(1.0, 0.0047, 0.0, 1e-5, ppd), sensitivity(1.0, 0.0053, 0.0, 1e-5, ppd),
                             sensitivity(34.1, 0.04, 13.5, 0.025, ppd)};
  const Weights edge_x = feature(false, false, ppd);
  const Weights edge_y = feature(false, true, ppd);
  const Weights point_x = feature(true, false, ppd);
  const Weights point_y = feature(true, true, ppd);
  Seen seen;
  for (int y = 0; y < static_cast<int>(picture.height); ++y) {
    for (int x = 0; x < static_cast<int>(picture.width); ++x) {
      Color color;
      for (std::size_t channel = 0; channel < 3; ++channel)
        color[channel] = filtered(image, picture, x, y, channel, filters[channel]);
      Color rgb = flip::linear_from_ycxcz(color);
      for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
      seen.lab.push_back(flip::hunt_lab_from_linear(rgb));
      const auto of_luminance = [&](const Weights& w) { return filtered(image, picture, x, y, 0, w) / 116.0; };
      seen.edges.push_back(std::hypot(of_luminance(edge_x), of_luminance(edge_y)));
      seen.points.push_back(std::hypot(of_luminance(point_x), of_luminance(point_y)));
    }
  }
  return seen;
}

std::vector<double> brute_flip(const EncodedPicture& reference, const EncodedPicture& test, double ppd) {
  const Seen a = brute_features(reference, ppd);
  const Seen b = brute_features(test, ppd);
  const double largest =
      std::pow(flip::hyab(flip::hunt_lab_from_linear({0, 1, 0}), flip::hunt_lab_from_linear({0, 0, 1})), 0.7);
  std::vector<double> errors;
  for (std::size_t i = 0; i < a.lab.size(); ++i) {
    const double difference = std::pow(flip::hyab(a.lab[i], b.lab[i]), 0.7);
    const double knee = 0.4 * largest;
    const double color =
        difference < knee ? 0.95 / knee * difference : 0.95 + (difference - knee) / (largest - knee) * (1.0 - 0.95);
    const double features = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
    errors.push_back(std::pow(color, 1.0 - std::sqrt(features / std::sqrt(2.0))));
  }
  return errors;
}

TEST(flip, separable_filters_say_what_filters_in_two_dimensions_say) {
  for (const double ppd : {kFlipPixelsPerDegree, 20.0}) {
    for (const auto& [width, height] :
         {std::pair{23u, 17u}, std::pair{1u, 1u}, std::pair{1u, 9u}, std::pair{31u, 2u}}) {
      const EncodedPicture reference = random_encoded(width, height, 3);
      const EncodedPicture test = random_encoded(width, height, 4);
      const std::vector<float> map =
          flip_error_map(flip_features(reference.pixels(), ppd), flip_features(test.pixels(), ppd));
      const std::vector<double> expected = brute_flip(reference, test, ppd);
      ASSERT_EQ(map.size(), expected.size());
      for (std::size_t i = 0; i < map.size(); ++i)
        ASSERT_NEAR(map[i], expected[i], 1e-5) << width << "x" << height << " at " << i;
    }
  }
}

TEST(flip, of_the_same_picture_is_nothing) {
  for (const std::uint32_t size : {1u, 2u, 33u}) {
    const EncodedPicture picture = random_encoded(size, size, size);
    EXPECT_EQ(flip_of(picture, picture).max, 0.0);
  }
}

TEST(flip, does_not_care_which_picture_is_the_reference) {
  const EncodedPicture a = random_encoded(19, 12, 1);
  const EncodedPicture b = random_encoded(19, 12, 2);
  EXPECT_DOUBLE_EQ(flip_of(a, b).mean, flip_of(b, a).mean);
}

TEST(flip, lies_between_nothing_and_one_for_the_most_different_colors) {
  const auto filled = [](std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    EncodedPicture picture{8, 8, {}};
    for (int i = 0; i < 64; ++i) picture.rgba.insert(picture.rgba.end(), {r, g, b, 255});
    return picture;
  };
  EXPECT_NEAR(flip_of(filled(0, 255, 0), filled(0, 0, 255)).mean, 1.0, 1e-6);
  EXPECT_GT(flip_of(filled(0, 0, 0), filled(255, 255, 255)).mean, 0.9);
  EXPECT_LE(flip_of(filled(0, 0, 0), filled(255, 255, 255)).mean, 1.0);
}

TEST(flip, ignores_what_opacity_says) {
  EncodedPicture a = random_encoded(7, 5, 1);
  const EncodedPicture b = a;
  for (std::size_t i = 3; i < a.rgba.size(); i += 4) a.rgba[i] = static_cast<std::uint8_t>(255 - a.rgba[i]);
  EXPECT_EQ(flip_of(a, b).max, 0.0);
}

TEST(flip, rejects_pictures_that_cannot_be_compared) {
  const EncodedPicture a = random_encoded(4, 4, 1);
  const EncodedPicture b = random_encoded(4, 5, 1);
  const FlipFeatures features = flip_features(a.pixels());
  EXPECT_ASSERT((void)flip_error_map(features, flip_features(b.pixels())), "different sizes");
  EXPECT_ASSERT((void)flip_error_map(features, flip_features(a.pixels(), 30.0)), "one viewing condition");
  EXPECT_ASSERT((void)flip_features(EncodedPixels{}), "at least one pixel");
  EXPECT_ASSERT((void)flip_features(EncodedPixels{2, 2, a.rgba}), "four numbers a pixel");
  EXPECT_ASSERT((void)flip_features(a.pixels(), 0.0), "pixels per degree");
}

}  // namespace
}  // namespace gloam
