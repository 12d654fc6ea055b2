// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Largest allowed distance between a simplified caster's surface and the full one: the larger of kSimplifiedError_m,
/// in the mesh's units, and kSimplifiedShare of the mesh's longest side.
inline constexpr float kSimplifiedError_m = 0.002f;
inline constexpr float kSimplifiedShare = 0.01f;

/// Fewer triangles of the same vertices with almost the same surface. Empty if less than a tenth can be saved or the
/// mesh has fewer than 32 triangles. Vertices at one position count as one, even if other attributes differ. Open
/// borders are kept, so that no gaps open where pieces meet; closed surfaces stay closed. Only for rigid meshes: a
/// deforming mesh may bend where it was flat.
[[nodiscard]] std::vector<std::uint32_t> simplified_indices(std::span<const vec3> positions,
                                                            std::span<const std::uint32_t> indices);

/// The same for a primitive whose vertices are renumbered as pack_primitive() does.
[[nodiscard]] std::vector<std::uint32_t> simplified_in_fetch_order(const Primitive& source);

}  // namespace gloam
