// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The packing of reflected distances into two bytes (hit_distance_api.glsl), run alone, and its twin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

using HitTexel = std::array<std::uint8_t, 4>;

inline constexpr std::uint32_t kMostHitDistances = 65536;

/// The texels that hold these distances; at most kMostHitDistances.
[[nodiscard]] Result<std::vector<HitTexel>> pack_hit_distances(const KernelLab& lab, std::vector<float> metres);
[[nodiscard]] Result<std::vector<float>> unpack_hit_distances(const KernelLab& lab, std::vector<HitTexel> texels);

[[nodiscard]] inline std::uint32_t centimetres_of(const HitTexel& texel) { return texel[0] + 256u * texel[1]; }
/// Centimetres, not rounded, that a texel must hold: what does not fit saturates, and what means nothing is 0.
[[nodiscard]] double held_centimetres(double metres);

}  // namespace gloam
