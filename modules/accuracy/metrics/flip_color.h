// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace gloam::flip {

using Color = std::array<double, 3>;

/// Of an sRGB-encoded channel.
[[nodiscard]] double linear_from_encoded(std::uint8_t encoded);

/// Luminance and two opponent axes, of linear RGB in 0…1 (paper, §4.1).
[[nodiscard]] Color ycxcz_from_linear(const Color& rgb);
[[nodiscard]] Color linear_from_ycxcz(const Color& ycxcz);

/// L*a*b* with a* and b* weighted by L* for the Hunt effect (§4.1.2), of linear RGB.
[[nodiscard]] Color hunt_lab_from_linear(const Color& rgb);

/// HyAB distance of two such colours (§4.1.2).
[[nodiscard]] double hyab(const Color& a, const Color& b);

}  // namespace gloam::flip
