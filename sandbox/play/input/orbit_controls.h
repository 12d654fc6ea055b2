// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/render/view.h"
#include "sandbox/session/session.h"
#include "sandbox/window/fly_camera.h"
#include "sandbox/window/window.h"

namespace gloam {

/// A place in a window, in pixels from its upper left corner, and how its picture was drawn.
struct WindowPlace {
  double x = 0.0;
  double y = 0.0;
  double scale = 1.0;  ///< of the picture's width and height to the window's
};

/// The pixel of the view's last frame at a place of its window; none outside the window. view: at the window's size.
[[nodiscard]] std::optional<uvec2> pixel_at(const ViewSettings& view, const WindowPlace& place);

/// Orbits the camera around a point of the scene and approaches it. The right button takes the point under the pointer
/// as the pivot, F too and looks at it. Where only the sky is seen, the pivot stays; the first one is the point in the
/// middle of the picture, or one 5 m away.
class OrbitControls {
 public:
  /// The session must outlive it.
  explicit OrbitControls(Session& session) : session_(session) {}

  /// Adds what the input asks for to the movement of a frame. Draws the last frame again where it needs a point's
  /// position.
  [[nodiscard]] Status add(const WindowInput& input, const ViewSettings& view, double scale, FlyInput& flight);
  /// Forgets the pivot.
  void reset() { pivot_.reset(); }

 private:
  [[nodiscard]] Status take_pivot(const ViewSettings& view, const WindowPlace& place);

  Session& session_;
  std::optional<dvec3> pivot_;
};

}  // namespace gloam
