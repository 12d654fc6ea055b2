// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/math/types.h"
#include "engine/render/view.h"

namespace gloam {

/// A line of sight; direction of unit length.
struct SightLine {
  dvec3 from = dvec3(0.0);
  dvec3 direction = dvec3(0.0, 0.0, -1.0);
};

/// The place of a world position in a view's picture, in pixels from its upper left corner; it may lie outside. None
/// behind the camera. view: its world_from_camera and camera are used.
[[nodiscard]] std::optional<glm::dvec2> place_in_picture(const ViewSettings& view, const dvec3& position);
[[nodiscard]] SightLine sight_line(const ViewSettings& view, const glm::dvec2& place);

/// The parameter t of the point origin + t · axis of a line that is nearest to the line of sight; none if the two are
/// almost parallel. axis: unit length.
[[nodiscard]] std::optional<double> nearest_on_axis(const SightLine& sight, const dvec3& origin, const dvec3& axis);
/// The point of the line of sight in the plane through `point` that faces the camera; none if it does not meet it.
[[nodiscard]] std::optional<dvec3> in_facing_plane(const ViewSettings& view, const SightLine& sight,
                                                   const dvec3& point);

}  // namespace gloam
