// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/ext/vector_double2.hpp>
#include <span>

#include "engine/math/types.h"
#include "engine/math/view_projection.h"

namespace gloam {

/// Rectangle in normalised device coordinates, Y up.
struct ScreenRect {
  glm::dvec2 low = glm::dvec2(-1.0);
  glm::dvec2 high = glm::dvec2(1.0);
  [[nodiscard]] bool empty() const { return !(low.x <= high.x && low.y <= high.y); }
};

/// The tight rectangle of the part of a convex hull that is beyond the near plane and inside `limit` on the screen.
/// `points`: in view space.
[[nodiscard]] ScreenRect hull_on_screen(std::span<const dvec3> points, const ViewProjection& view,
                                        const ScreenRect& limit);

}  // namespace gloam
