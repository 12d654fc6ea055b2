// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "modules/accuracy/metrics/pixels.h"

namespace gloam::test {

struct EncodedPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
  [[nodiscard]] EncodedPixels pixels() const { return {width, height, rgba}; }
};

struct FloatPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> rgba;
  [[nodiscard]] LinearPixels pixels() const { return {width, height, rgba}; }
};

/// Noisy blocks of colour: edges, flat areas and points.
inline EncodedPicture random_encoded(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
  std::mt19937 random(seed);
  EncodedPicture picture{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      for (std::uint32_t channel = 0; channel < 4; ++channel) {
        const std::uint32_t block = ((x / 5) * 7 + (y / 4) * 13 + channel * 29 + seed * 3) * 37 % 256;
        picture.rgba.push_back(static_cast<std::uint8_t>(random() % 4 == 0 ? random() % 256 : block));
      }
    }
  }
  return picture;
}

inline FloatPicture random_linear(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> light(0.0f, 50.0f);
  FloatPicture picture{width, height, std::vector<float>(std::size_t{width} * height * 4)};
  for (float& value : picture.rgba) value = light(random);
  return picture;
}

}  // namespace gloam::test
