// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/pictures/picture_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

#include "engine/core/assert.h"
#include "engine/math/srgb.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSmallWidth = 480;
/// Up to this width the PNG itself is small.
constexpr std::uint32_t kEmbeddedWidth = 100;
constexpr int kQuality = 85;  // a picture of 480×270 has 20 to 40 kB

/// Light of every sRGB code.
std::array<float, 256> light_of_codes() {
  std::array<float, 256> light{};
  for (std::size_t code = 0; code < light.size(); ++code)
    light[code] = srgb_to_linear(static_cast<float>(code) / 255.0f);
  return light;
}

struct Weight {
  std::size_t index = 0;
  float share = 0.0f;
};

/// The old samples that a sample of `count` covers, with their shares, which add up to 1.
std::vector<Weight> covered(std::size_t sample, std::size_t count, std::size_t old_count) {
  const double size = static_cast<double>(old_count) / static_cast<double>(count);
  const double begin = static_cast<double>(sample) * size;
  const double end = begin + size;
  std::vector<Weight> weights;
  for (auto i = static_cast<std::size_t>(begin); i < old_count && static_cast<double>(i) < end; ++i) {
    const double share = std::min(end, static_cast<double>(i) + 1.0) - std::max(begin, static_cast<double>(i));
    if (share > 0.0) weights.push_back({i, static_cast<float>(share / size)});
  }
  return weights;
}

}  // namespace

Picture shrunk(const Picture& picture, std::uint32_t width) {
  GLOAM_ASSERT(width > 0 && width <= picture.width, "a picture shrinks");
  const double scale = static_cast<double>(width) / picture.width;
  const auto height = static_cast<std::uint32_t>(std::max(1.0, std::round(picture.height * scale)));
  const std::array<float, 256> light = light_of_codes();
  std::vector<std::vector<Weight>> columns;
  for (std::uint32_t x = 0; x < width; ++x) columns.push_back(covered(x, width, picture.width));
  Picture result = {width, height, {}};
  result.rgba.reserve(std::size_t{width} * height * 4);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::vector<Weight> rows = covered(y, height, picture.height);
    for (const std::vector<Weight>& column : columns) {
      std::array<float, 3> sum{};
      for (const Weight& row : rows) {
        for (const Weight& old : column) {
          const std::size_t texel = (row.index * picture.width + old.index) * 4;
          for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += row.share * old.share * light[picture.rgba[texel + channel]];
        }
      }
      for (const float value : sum)
        result.rgba.push_back(
            static_cast<std::uint8_t>(std::lround(255.0f * linear_to_srgb(std::clamp(value, 0.0f, 1.0f)))));
      result.rgba.push_back(255);
    }
  }
  return result;
}

Status PictureFolder::save(const std::string& name, const Picture& picture) const {
  if (has(name)) return {};
  GLOAM_TRY(make_folder_of(small_path(name)));
  if (picture.width > kEmbeddedWidth) {
    const Picture small = shrunk(picture, std::min(picture.width, kSmallWidth));
    const auto bytes = jpeg_bytes(small.width, small.height, small.rgba, kQuality);
    if (!bytes) return bytes.error();
    GLOAM_TRY(write_file(small_path(name), *bytes));
  }
  // Last, because it tells that the picture is complete.
  return write_png(full_path(name), picture.width, picture.height, picture.rgba);
}

bool PictureFolder::has(const std::string& name) const {
  std::error_code failed;
  return std::filesystem::exists(full_path(name), failed);
}

std::optional<std::string> PictureFolder::small_file(const std::string& name) const {
  if (!has(name)) return std::nullopt;
  std::error_code failed;
  const bool has_small = std::filesystem::exists(small_path(name), failed);
  auto bytes = read_text_file(has_small ? small_path(name) : full_path(name), ErrorKind::failed);
  if (!bytes) return std::nullopt;
  return std::move(bytes).value();
}

}  // namespace gloam
