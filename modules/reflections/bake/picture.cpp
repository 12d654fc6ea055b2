// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/math/packing.h"

namespace gloam {
namespace {

constexpr float kLargestHalf = 65504.0f;

float storable_channel(float value) { return value > 0.0f ? std::min(value, kLargestHalf) : 0.0f; }

/// A texel of a line and its weight in one texel of the resampled line. The weights of a resampled texel sum to 1.
struct TexelShare {
  std::uint32_t from = 0;
  float share = 0.0f;
};

std::vector<TexelShare> shares_of(std::uint32_t target, std::uint32_t target_size, std::uint32_t source_size) {
  const double scale = static_cast<double>(source_size) / target_size;
  const std::uint32_t last = source_size - 1;
  if (scale < 1.0) {
    const double at = std::clamp((target + 0.5) * scale - 0.5, 0.0, static_cast<double>(last));
    const auto from = static_cast<std::uint32_t>(at);
    const auto share = static_cast<float>(at - from);
    return {{from, 1.0f - share}, {std::min(from + 1, last), share}};
  }
  const double begin = target * scale, end = (target + 1) * scale;
  std::vector<TexelShare> shares;
  for (auto from = static_cast<std::uint32_t>(begin); from <= last && from < end; ++from) {
    const double covered = std::min(end, from + 1.0) - std::max(begin, static_cast<double>(from));
    shares.push_back({from, static_cast<float>(covered / scale)});
  }
  return shares;
}

CapturedPicture halved(const CapturedPicture& picture) {
  CapturedPicture half{picture.width / 2, picture.height / 2, {}};
  half.texels.reserve(std::size_t{half.width} * half.height);
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x) {
      const vec4* const at = &picture.texels[std::size_t{2} * y * picture.width + std::size_t{2} * x];
      half.texels.push_back(0.25f * (at[0] + at[1] + at[picture.width] + at[picture.width + 1]));
    }
  return half;
}

}  // namespace

vec3 storable(const vec3& light) {
  return {storable_channel(light.x), storable_channel(light.y), storable_channel(light.z)};
}

CapturedPicture resampled(const CapturedPicture& picture, std::uint32_t side) {
  // First horizontally: one line of the target's width per line of the source.
  std::vector<vec4> lines(std::size_t{side} * picture.height);
  for (std::uint32_t x = 0; x < side; ++x) {
    const std::vector<TexelShare> shares = shares_of(x, side, picture.width);
    for (std::uint32_t y = 0; y < picture.height; ++y) {
      vec4 sum(0.0f);
      for (const TexelShare& s : shares) sum += s.share * picture.texels[std::size_t{y} * picture.width + s.from];
      lines[std::size_t{y} * side + x] = sum;
    }
  }
  CapturedPicture square{side, side, std::vector<vec4>(std::size_t{side} * side)};
  for (std::uint32_t y = 0; y < side; ++y) {
    const std::vector<TexelShare> shares = shares_of(y, side, picture.height);
    for (std::uint32_t x = 0; x < side; ++x) {
      vec4 sum(0.0f);
      for (const TexelShare& s : shares) sum += s.share * lines[std::size_t{s.from} * side + x];
      square.texels[std::size_t{y} * side + x] = sum;
    }
  }
  return square;
}

void append_halves(const CapturedPicture& picture, std::vector<std::uint16_t>& halves) {
  for (const vec4& texel : picture.texels)
    for (int channel = 0; channel < 4; ++channel) halves.push_back(float_to_half(texel[channel]));
}

void append_mip_chain(CapturedPicture picture, std::vector<std::uint16_t>& halves) {
  append_halves(picture, halves);
  while (picture.width > 1) {
    picture = halved(picture);
    append_halves(picture, halves);
  }
}

}  // namespace gloam
