// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"

namespace gloam {

/// Whether the vertex normals of any triangle describe a curved surface: one of them is not perpendicular to an edge.
/// normals: one per position, unit.
[[nodiscard]] bool is_smooth_shaded(std::span<const vec3> positions, std::span<const vec3> normals,
                                    std::span<const std::uint32_t> indices);

}  // namespace gloam
