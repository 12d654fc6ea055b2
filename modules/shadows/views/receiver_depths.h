// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "engine/math/types.h"
#include "engine/render/view.h"

namespace gloam {

/// The view depths between which a view shows surfaces, in metres; a view resource, written by system shadow_bounds.
/// Conservative: no surface of a mesh, or inside a CasterVolume, is outside the range.
struct ReceiverDepths {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();

  /// False when the view shows nothing.
  [[nodiscard]] bool any() const { return nearest <= farthest; }
  void grow(const ReceiverDepths& other) {
    nearest = nearest < other.nearest ? nearest : other.nearest;
    farthest = farthest > other.farthest ? farthest : other.farthest;
  }
};

/// The depths of the part of a world-space box that lies inside a perspective view's frustum. Depths from the near
/// plane to infinity if a corner is not finite.
[[nodiscard]] ReceiverDepths depths_in_view(const RenderView& view, const dvec3& low, const dvec3& high);

}  // namespace gloam
