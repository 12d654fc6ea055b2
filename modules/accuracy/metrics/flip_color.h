// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace gloam::flip {

using Color = std::array<double, 3>;

/// Linear RGB in 0…1 to luminance and two opponent axes (paper, §4.1), and back.
[[nodiscard]] Color ycxcz_from_linear(const Color& rgb);
[[nodiscard]] Color linear_from_ycxcz(const Color& ycxcz);

/// Linear RGB to L*a*b*, with a* and b* weighted by L* for the Hunt effect (§4.1.2).
[[nodiscard]] Color hunt_lab_from_linear(const Color& rgb);

/// HyAB distance of two colours from hunt_lab_from_linear (§4.1.2).
[[nodiscard]] double hyab(const Color& a, const Color& b);

}  // namespace gloam::flip
