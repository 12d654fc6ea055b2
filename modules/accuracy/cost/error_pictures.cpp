// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/error_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr std::size_t kGap = 2;  // pixels between the two halves and between areas

/// Colours at equal steps; their lightness rises, so that the order is seen without colour, too.
constexpr std::array<std::array<float, 3>, 5> kRamp = {
    {{0, 0, 0}, {70, 20, 120}, {185, 55, 105}, {250, 145, 55}, {255, 250, 195}}};

std::uint8_t ramp_channel(float position, std::size_t channel) {
  const float scaled = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(kRamp.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(scaled), kRamp.size() - 2);
  const float share = scaled - static_cast<float>(below);
  return static_cast<std::uint8_t>(
      std::lround(kRamp[below][channel] + share * (kRamp[below + 1][channel] - kRamp[below][channel])));
}

/// Sums over all rectangles that begin at the top left pixel: (width + 1) · (height + 1) values.
class AreaSums {
 public:
  AreaSums(std::span<const float> values, std::uint32_t width, std::uint32_t height)
      : stride_(std::size_t{width} + 1), sums_(stride_ * (std::size_t{height} + 1), 0.0) {
    for (std::size_t y = 0; y < height; ++y) {
      double row = 0.0;
      for (std::size_t x = 0; x < width; ++x) {
        row += static_cast<double>(values[y * width + x]);
        sums_[(y + 1) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + row;
      }
    }
  }
  [[nodiscard]] double of(const PictureArea& area) const {
    const std::size_t top = area.y * stride_;
    const std::size_t bottom = (std::size_t{area.y} + area.height) * stride_;
    const std::size_t right = std::size_t{area.x} + area.width;
    return sums_[bottom + right] - sums_[bottom + area.x] - sums_[top + right] + sums_[top + area.x];
  }

 private:
  std::size_t stride_;
  std::vector<double> sums_;
};

bool overlaps(const PictureArea& a, const PictureArea& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::optional<PictureArea> worst_besides(const std::vector<PictureArea>& taken, const AreaSums& sums,
                                         std::uint32_t width, std::uint32_t height) {
  PictureArea area = {.width = std::min(kWorstWidth, width), .height = std::min(kWorstHeight, height)};
  std::optional<PictureArea> worst;
  double most = 1e-6;  // sums of zeros differ from 0 by rounding
  for (area.y = 0; area.y + area.height <= height; ++area.y) {
    for (area.x = 0; area.x + area.width <= width; ++area.x) {
      const double sum = sums.of(area);
      if (sum <= most || std::ranges::any_of(taken, [&](const PictureArea& other) { return overlaps(area, other); }))
        continue;
      most = sum;
      worst = area;
    }
  }
  return worst;
}

}  // namespace

Picture heat_map(std::span<const float> flip, std::uint32_t width, std::uint32_t height) {
  GLOAM_ASSERT(flip.size() == std::size_t{width} * height, "a heat map has one error a pixel");
  Picture map = {width, height, {}};
  map.rgba.reserve(flip.size() * 4);
  for (const float error : flip) {
    const float position = std::sqrt(std::max(error, 0.0f));
    for (std::size_t channel = 0; channel < 3; ++channel) map.rgba.push_back(ramp_channel(position, channel));
    map.rgba.push_back(255);
  }
  return map;
}

std::vector<PictureArea> worst_areas(std::span<const float> flip, std::uint32_t width, std::uint32_t height) {
  GLOAM_ASSERT(flip.size() == std::size_t{width} * height, "a map has one error a pixel");
  const AreaSums sums(flip, width, height);
  std::vector<PictureArea> areas;
  while (areas.size() < kWorstAreas) {
    const std::optional<PictureArea> worst = worst_besides(areas, sums, width, height);
    if (!worst) break;
    areas.push_back(*worst);
  }
  return areas;
}

Picture side_by_side(const Picture& picture, const Picture& reference, std::span<const PictureArea> areas) {
  GLOAM_ASSERT(!areas.empty(), "there is an area to show");
  const std::size_t width = areas.front().width;
  const std::size_t height = areas.front().height;
  Picture result = {static_cast<std::uint32_t>(2 * width + kGap),
                    static_cast<std::uint32_t>(areas.size() * (height + kGap) - kGap),
                    {}};
  result.rgba.assign(std::size_t{result.width} * result.height * 4, 0);
  const auto copy = [&](const Picture& from, const PictureArea& area, std::size_t left, std::size_t top) {
    for (std::size_t y = 0; y < height; ++y) {
      const std::size_t source = ((area.y + y) * from.width + area.x) * 4;
      const std::size_t target = ((top + y) * result.width + left) * 4;
      std::copy_n(from.rgba.begin() + static_cast<std::ptrdiff_t>(source), width * 4,
                  result.rgba.begin() + static_cast<std::ptrdiff_t>(target));
    }
  };
  for (std::size_t i = 0; i < areas.size(); ++i) {
    copy(picture, areas[i], 0, i * (height + kGap));
    copy(reference, areas[i], width + kGap, i * (height + kGap));
  }
  return result;
}

}  // namespace gloam
