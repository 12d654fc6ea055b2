// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/edge_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/assert.h"

namespace gloam {
namespace {

double luma_of(const EncodedPixels& picture, std::size_t pixel) {
  const auto channel = [&](std::size_t c) { return static_cast<double>(picture.rgba[pixel * 4 + c]) / 255.0; };
  return 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
}

}  // namespace

std::vector<bool> near_edges(const EncodedPixels& picture) {
  GLOAM_ASSERT(picture.whole(), "a picture has four numbers a pixel and at least one pixel");
  std::vector<bool> near(picture.count(), false);
  const auto mark = [&](std::size_t x, std::size_t y) {
    constexpr std::size_t kReach = kEdgeReach - 1;
    for (std::size_t row = y - std::min(y, kReach); row <= y + kReach && row < picture.height; ++row)
      for (std::size_t column = x - std::min(x, kReach); column <= x + kReach && column < picture.width; ++column)
        near[row * picture.width + column] = true;
  };
  const auto compare = [&](std::size_t x, std::size_t y, std::size_t other_x, std::size_t other_y) {
    const double step = luma_of(picture, y * picture.width + x) - luma_of(picture, other_y * picture.width + other_x);
    if (std::abs(step) < kEdgeStep) return;
    mark(x, y);
    mark(other_x, other_y);
  };
  for (std::size_t y = 0; y < picture.height; ++y) {
    for (std::size_t x = 0; x < picture.width; ++x) {
      if (x + 1 < picture.width) compare(x, y, x + 1, y);
      if (y + 1 < picture.height) compare(x, y, x, y + 1);
    }
  }
  return near;
}

std::optional<EdgeStatistics> edge_error(const std::vector<bool>& near, std::span<const float> flip,
                                         const EncodedPixels& reference, const EncodedPixels& test) {
  GLOAM_ASSERT(reference.whole() && test.whole() && reference.same_size(test), "pictures of one size are compared");
  GLOAM_ASSERT(near.size() == reference.count() && flip.size() == near.size(), "maps have one value a pixel");
  std::vector<float> errors;
  double squares = 0.0;
  for (std::size_t pixel = 0; pixel < near.size(); ++pixel) {
    if (!near[pixel]) continue;
    errors.push_back(flip[pixel]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::size_t at = pixel * 4 + channel;
      const double difference = (static_cast<double>(test.rgba[at]) - reference.rgba[at]) / 255.0;
      squares += difference * difference;
    }
  }
  if (errors.empty()) return std::nullopt;
  const auto count = static_cast<double>(errors.size());
  return EdgeStatistics{
      .flip = statistics_of(errors),
      .psnr_db = squares == 0.0 ? std::numeric_limits<double>::infinity() : -10.0 * std::log10(squares / (3.0 * count)),
      .share = count / static_cast<double>(near.size())};
}

}  // namespace gloam
