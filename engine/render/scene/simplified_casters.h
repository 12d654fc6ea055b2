// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// How far a simplified caster's surface may be from the full one's: the larger of a length in the mesh's units and a
/// share of its longest side.
inline constexpr float kSimplifiedError_m = 0.002f;
inline constexpr float kSimplifiedShare = 0.01f;

/// Triangles of the same vertices that look alike from everywhere but are fewer; empty when hardly any can be spared.
/// Vertices at one place count as one, whatever else tells them apart. Open borders stay as they are, so that pieces
/// that meet there do not gape; what is closed stays closed. For rigid meshes: what moves by itself may bend where it
/// was flat.
[[nodiscard]] std::vector<std::uint32_t> simplified_indices(std::span<const vec3> positions,
                                                            std::span<const std::uint32_t> indices);

}  // namespace gloam
