// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "engine/math/bounds.h"
#include "engine/math/types.h"

/// Bounds in the world. In double: floats are too coarse far from the world's origin.
namespace gloam {

/// Axis-aligned box in the world; a default box is unknown.
struct WorldBox {
  dvec3 min = dvec3(std::numeric_limits<double>::infinity());
  dvec3 max = dvec3(-std::numeric_limits<double>::infinity());

  /// False for empty boxes and for boxes computed from values that are not finite.
  [[nodiscard]] bool known() const;
};

/// World-space bounds of a transformed box. The matrix must be affine.
[[nodiscard]] WorldBox world_box(const Aabb& box, const dmat4& world_from_box);

/// Length of half the diagonal of a transformed box, in metres; exact if the matrix does not shear. It does not change
/// when the box turns.
[[nodiscard]] double half_diagonal(const Aabb& box, const dmat4& world_from_box);

}  // namespace gloam
