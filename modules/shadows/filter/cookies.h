// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/assets.h"
#include "modules/lights/components.h"

namespace gloam {

/// Pixels of a side of a cookie on the GPU, whatever its file has.
inline constexpr std::uint32_t kCookieSide = 512;

/// The images that spot lights project; a resource of the world. One that could not be read is white.
struct Cookies {
  std::map<std::uint32_t, std::uint32_t> layers;  ///< by Light::cookie
  std::vector<std::vector<std::uint8_t>> texels;  ///< by layer: sRGB, kCookieSide² · 4 bytes, rows from the top
  std::vector<std::string> faults;                ///< of those that could not be read
  std::uint64_t version = 0;                      ///< another one whenever there are more
};

/// Whether a light projects an image.
[[nodiscard]] inline bool has_cookie(const Light& light) { return light.kind == LightKind::spot && light.cookie != 0; }
[[nodiscard]] std::size_t count_cookie_lights(const World& world);

/// Reads the images of all spot lights that are not there yet. Input error of the first that cannot be read; the others
/// are there.
[[nodiscard]] Status load_cookies(World& world);

/// The picture at kCookieSide²: each pixel the mean linear light of what it covers, or between pixels where there are
/// fewer.
[[nodiscard]] std::vector<std::uint8_t> resampled_cookie(const Image& image);

}  // namespace gloam
