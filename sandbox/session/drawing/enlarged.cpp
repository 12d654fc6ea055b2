// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/enlarged.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gloam {
namespace {

float lanczos(float x) {
  const float x2 = std::min(x * x, 4.0f);
  const float a = 0.4f * x2 - 1.0f;
  const float b = 0.25f * x2 - 1.0f;
  return (25.0f / 16.0f * a * a - 9.0f / 16.0f) * (b * b);
}

/// The four texels around a pixel, along one axis.
struct Taps {
  std::array<std::size_t, 4> at{};
  std::array<float, 4> weights{};
};

std::vector<Taps> taps_of(std::uint32_t from, std::uint32_t to) {
  std::vector<Taps> all(to);
  for (std::uint32_t pixel = 0; pixel < to; ++pixel) {
    const float along = (static_cast<float>(pixel) + 0.5f) * static_cast<float>(from) / static_cast<float>(to) - 0.5f;
    const float first = std::floor(along);
    const float part = along - first;
    Taps& taps = all[pixel];
    for (int i = 0; i < 4; ++i) {
      const int texel = static_cast<int>(first) - 1 + i;
      taps.at[static_cast<std::size_t>(i)] = static_cast<std::size_t>(std::clamp(texel, 0, static_cast<int>(from) - 1));
    }
    taps.weights = {lanczos(1.0f + part), lanczos(part), lanczos(1.0f - part), lanczos(2.0f - part)};
    const float sum = taps.weights[0] + taps.weights[1] + taps.weights[2] + taps.weights[3];
    for (float& weight : taps.weights) weight /= sum;
  }
  return all;
}

/// Kept between the two nearest texels, so that edges do not ring.
float filtered(const Taps& taps, const float* texels, std::size_t stride) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < 4; ++i) sum += taps.weights[i] * texels[taps.at[i] * stride];
  const float a = texels[taps.at[1] * stride], b = texels[taps.at[2] * stride];
  return std::clamp(sum, std::min(a, b), std::max(a, b));
}

/// values: four a pixel.
std::vector<float> resized(const std::vector<float>& values, std::uint32_t from_width, std::uint32_t from_height,
                           std::uint32_t width, std::uint32_t height) {
  const std::vector<Taps> across = taps_of(from_width, width), down = taps_of(from_height, height);
  std::vector<float> wide(std::size_t{width} * from_height * 4), result(std::size_t{width} * height * 4);
  for (std::size_t y = 0; y < from_height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        wide[(y * width + x) * 4 + c] = filtered(across[x], &values[y * from_width * 4 + c], 4);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t i = 0; i < std::size_t{width} * 4; ++i)
      result[y * width * 4 + i] = filtered(down[y], &wide[i], std::size_t{width} * 4);
  return result;
}

}  // namespace

std::uint32_t scaled_size(std::uint32_t size, double scale) {
  return std::max(static_cast<std::uint32_t>(std::lround(size * scale)), 1u);
}

void set_scaled_size(ViewSettings& view, std::uint32_t width, std::uint32_t height, double scale) {
  view.width = scaled_size(width, scale);
  view.height = scaled_size(height, scale);
  const bool whole = view.width == width && view.height == height;
  view.aspect = whole ? 0.0f : static_cast<float>(width) / static_cast<float>(height);
}

Picture enlarged(const Picture& picture, std::uint32_t width, std::uint32_t height) {
  if (picture.width == width && picture.height == height) return picture;
  const std::vector<float> values(picture.rgba.begin(), picture.rgba.end());
  Picture result = {width, height, {}};
  result.rgba.reserve(std::size_t{width} * height * 4);
  for (const float value : resized(values, picture.width, picture.height, width, height))
    result.rgba.push_back(static_cast<std::uint8_t>(std::lround(value)));
  return result;
}

LinearPicture enlarged(const LinearPicture& picture, std::uint32_t width, std::uint32_t height) {
  if (picture.width == width && picture.height == height) return picture;
  return {width, height, resized(picture.rgba, picture.width, picture.height, width, height)};
}

}  // namespace gloam
