// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/reflections/fitting/caught_rays.h"
#include "modules/reflections/fitting/region_quads.h"

namespace gloam {

/// Chooses at most `count` of the candidates that together catch the most rays: greedily, the one with the largest gain
/// first, then by exchanging chosen quads while that catches more. A quad in front of another one takes the other's
/// rays, so a quad may cost rays that it does not catch. Quads without gain are not chosen, also if fewer than `count`
/// are. Returns indices of candidates in the order of their gain.
[[nodiscard]] std::vector<std::uint32_t> choose_quads(std::span<const PlacedProxy> candidates, std::size_t count,
                                                      std::span<const PlacedRoom> rooms,
                                                      std::span<const ReflectedRay> rays, JobExecutor& jobs);

}  // namespace gloam
