// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"

namespace gloam {

/// Whether triangles form closed surfaces whose fronts (counter-clockwise corners) are outside: every edge is passed as
/// often in one direction as in the other, and the enclosed volume is positive. Vertices at the same position count as
/// one. Seen from outside, the fronts alone then cover what all triangles cover.
[[nodiscard]] bool is_closed_surface(std::span<const vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace gloam
