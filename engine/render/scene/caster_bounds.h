// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/bounds.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/scene/resources.h"

/// Where in the world what a primitive draws lies. In double: floats are not enough far from the world's origin.
namespace gloam {

/// Axis-aligned box in the world; the default one is "not known".
struct WorldBox {
  dvec3 min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 max = dvec3(-std::numeric_limits<double>::infinity());

  /// False for empty boxes and for those that numbers which are not finite went into.
  [[nodiscard]] bool known() const;
};

/// Box of a transformed box. The matrix is affine.
[[nodiscard]] WorldBox world_box(const Aabb& box, const dmat4& world_from_box);

/// GpuPrimitive::joint_bounds. `influences`: one a position. From the packed weights, because those are what the GPU
/// skins with.
[[nodiscard]] std::vector<std::pair<std::uint32_t, Aabb>> joint_bounds(const Primitive& primitive,
                                                                       std::span<const PackedInfluence> influences);

/// GpuPrimitive::morph_bounds.
[[nodiscard]] std::vector<Aabb> morph_bounds(const Primitive& primitive);

/// Bounds of what the targets add to a vertex with these weights: as many as the primitive has targets, of any sign.
[[nodiscard]] Aabb morph_reach(const GpuPrimitive& primitive, std::span<const float> weights);

/// Bounds of a skinned surface: a convex mix of points lies in the union of their boxes. `reach`: what morphing adds
/// before; an empty one adds nothing. Not known when a vertex follows a joint that the range lacks.
[[nodiscard]] WorldBox posed_box(const GpuPrimitive& primitive, const JointMatrices& joints,
                                 const JointMatrices::Range& range, const Aabb& reach);

}  // namespace gloam
