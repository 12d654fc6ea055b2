// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/view.h"
#include "sandbox/play/input/light_controls.h"
#include "sandbox/window/panel_mark.h"

namespace gloam {

/// Marks of a light in the picture that the pointer drags: three axes move it along the world's axes, and a square on
/// its line of light aims a spot or a directional light.
class LightGizmo {
 public:
  /// Handles the pointer in a frame. view: with the pose of the last frame. down: the left button is held. free: no
  /// other part of the window uses the pointer. Returns whether the gizmo uses it.
  bool steer(LightControls& lights, std::size_t light, const ViewSettings& view, const glm::dvec2& pointer, bool down,
             bool free);
  [[nodiscard]] std::vector<PanelMark> marks(const LightControls& lights, std::size_t light,
                                             const ViewSettings& view) const;
  [[nodiscard]] bool drags() const { return part_ != kNothing; }

 private:
  static constexpr int kNothing = -1;
  static constexpr int kAim = 3;  ///< parts 0, 1 and 2 are the axes

  [[nodiscard]] int part_at(const LightControls& lights, std::size_t light, const ViewSettings& view,
                            const glm::dvec2& pointer) const;
  void drag(LightControls& lights, std::size_t light, const ViewSettings& view, const glm::dvec2& pointer);

  int part_ = kNothing;  ///< that is being dragged
  bool was_down_ = false;
  dvec3 start_ = dvec3(0.0);  ///< of the light, when the drag began
  double grabbed_ = 0.0;      ///< along the axis, from start_
  double length_ = 1.0;       ///< of the axes, in metres
};

}  // namespace gloam
