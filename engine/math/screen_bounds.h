// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/bounds.h"

namespace gloam {

/// Rectangle in normalised device coordinates (−1…1, Y up), min ≤ max. `empty`: nothing is visible.
struct NdcRect {
  vec2 min = vec2(-1.0f);
  vec2 max = vec2(1.0f);
  bool empty = false;
};

/// Symmetric perspective: x_ndc = scale.x · x / d with d = −z. scale > 0, near_m > 0.
struct PerspectiveScale {
  vec2 scale = vec2(1.0f);
  float near_m = 0.1f;
};

/// Tight screen rectangle of a sphere in view space, clipped at the near plane and to the screen. Contains every
/// projected point of the sphere in front of the near plane; widened by a few ulps. NaN or infinity gives the whole
/// screen.
[[nodiscard]] NdcRect screen_bounds(const Sphere& view_sphere, const PerspectiveScale& projection);

/// The same for a solid spherical sector in view space, whose axis has unit length to within 1e-3. Never larger than
/// the rectangle of its bounding sphere.
[[nodiscard]] NdcRect screen_bounds(const Cone& view_cone, const PerspectiveScale& projection);

}  // namespace gloam
