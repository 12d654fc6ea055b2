// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam::test {

/// A WebP of RGBA pixels. quality: −1: lossless, transparent pixels included; 0…100: lossy.
[[nodiscard]] std::vector<std::uint8_t> encode_webp(int width, int height, std::span<const std::uint8_t> rgba,
                                                    float quality = -1.0f);
/// An animated WebP with the still image as its only frame.
[[nodiscard]] std::vector<std::uint8_t> animate_webp(int width, int height, std::span<const std::uint8_t> still);

}  // namespace gloam::test
