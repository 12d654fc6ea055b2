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

/// Pixels of a cookie's side on the GPU, independent of its file.
inline constexpr std::uint32_t kCookieSide = 512;

/// The cookies of a world's spot lights; a resource of the world. A cookie whose file could not be read is white.
struct Cookies {
  std::map<std::uint32_t, std::uint32_t> layers;  ///< layer by Light::cookie
  std::vector<std::vector<std::uint8_t>> texels;  ///< by layer: sRGB, kCookieSide² · 4 bytes, rows from the top
  std::vector<std::string> faults;                ///< one text per file that could not be read
  std::uint64_t version = 0;                      ///< changes whenever layers are added
};

/// Whether a light projects a cookie.
[[nodiscard]] inline bool has_cookie(const Light& light) { return light.kind == LightKind::spot && light.cookie != 0; }
/// Number of lights in the world with a cookie.
[[nodiscard]] std::size_t count_cookie_lights(const World& world);

/// Loads the cookies of all spot lights whose cookie is not loaded yet. Continues after an error; returns the input
/// error of the first file that could not be read.
[[nodiscard]] Status load_cookies(World& world);

/// The image resampled to kCookieSide², as sRGB bytes: each pixel is the mean linear light of the source pixels it
/// covers, or an interpolation where the source is smaller.
[[nodiscard]] std::vector<std::uint8_t> resampled_cookie(const Image& image);

}  // namespace gloam
