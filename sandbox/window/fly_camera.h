// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/math/types.h"
#include "engine/render/view.h"

namespace gloam {

/// What the user wants of the camera in one frame; movements in −1…1 along the camera's axes.
struct FlyInput {
  double forward = 0.0;
  double right = 0.0;
  double up = 0.0;     ///< along the world's +Y
  double turn = 0.0;   ///< radians to the left
  double tilt = 0.0;   ///< radians upwards
  double speed = 1.0;  ///< factor on the camera's speed
};

/// A camera that flies where it looks; never rolls, never tips over.
class FlyCamera {
 public:
  /// Takes position and direction of a rigid pose (the camera looks along −Z); its roll is dropped.
  explicit FlyCamera(const dmat4& world_from_camera = dmat4(1.0));

  /// dt_s ≥ 0. Diagonal movement is no faster than straight.
  void advance(const FlyInput& input, double dt_s);

  [[nodiscard]] dmat4 world_from_camera() const;

 private:
  dvec3 position_ = dvec3(0.0);
  double heading_ = 0.0;  ///< radians about +Y, 0 looks along −Z
  double tilt_ = 0.0;     ///< radians above the horizon
};

/// The camera of a view that follows the scene's until the user flies, and then the user's; its lens and effects stay
/// the scene's.
class ViewFlight {
 public:
  /// Moves the view, from where the world's camera is now when this is the user's first movement.
  void advance(const World& world, const FlyInput& input, double dt_s, ViewSettings& settings);

 private:
  std::optional<FlyCamera> camera_;  ///< none until the user flies
};

}  // namespace gloam
