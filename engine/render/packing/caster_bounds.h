// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/math/world_box.h"
#include "engine/render/packing/gpu_primitive.h"
#include "engine/scene/resources.h"

/// World-space bounds of drawn primitives.
namespace gloam {

/// Computes GpuPrimitive::joint_bounds. `influences`: one per position. Uses the packed weights, because the GPU skins
/// with them.
[[nodiscard]] std::vector<std::pair<std::uint32_t, Aabb>> joint_bounds(const Primitive& primitive,
                                                                       std::span<const PackedInfluence> influences);

/// Computes GpuPrimitive::morph_bounds.
[[nodiscard]] std::vector<Aabb> morph_bounds(const Primitive& primitive);

/// Bounds of the offsets that morphing with these weights adds to a vertex. weights: one per target, of any sign.
[[nodiscard]] Aabb morph_reach(const GpuPrimitive& primitive, std::span<const float> weights);

/// Bounds of a skinned surface: a skinned vertex is a convex mix of points and lies in the union of their boxes.
/// `reach`: bounds of the morph offsets, which are added before skinning; an empty box adds nothing. Unknown if a
/// vertex follows a joint that the range lacks.
[[nodiscard]] WorldBox posed_box(const GpuPrimitive& primitive, const JointMatrices& joints,
                                 const JointMatrices::Range& range, const Aabb& reach);

}  // namespace gloam
