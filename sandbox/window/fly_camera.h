// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/math/types.h"
#include "engine/render/view.h"

namespace gloam {

/// The user's input to the camera in one frame. Movements are −1…1 along the camera's axes.
struct FlyInput {
  double forward = 0.0;
  double right = 0.0;
  double up = 0.0;             ///< along the world's +Y
  double turn = 0.0;           ///< radians to the left
  double tilt = 0.0;           ///< radians upwards
  double speed = 1.0;          ///< factor on the camera's speed
  double orbit_turn = 0.0;     ///< radians to the right around the pivot
  double orbit_tilt = 0.0;     ///< radians upwards around the pivot
  double approach = 1.0;       ///< factor on the distance to the pivot
  bool look_at_pivot = false;  ///< turns the camera so that the pivot is in the middle of the picture
  dvec3 pivot = dvec3(0.0);    ///< world position, metres
};

/// A camera that flies along its view direction. It never rolls, and its tilt stays within ±89°.
class FlyCamera {
 public:
  /// Takes position and direction of a rigid pose (the camera looks along −Z); its roll is dropped.
  explicit FlyCamera(const dmat4& world_from_camera = dmat4(1.0));

  /// Looks at the pivot, orbits and approaches it, then turns and moves the camera. dt_s ≥ 0. Diagonal movement is no
  /// faster than straight movement. While it orbits, the pivot keeps its place in the picture; the camera comes no
  /// nearer to the pivot than a centimetre.
  void advance(const FlyInput& input, double dt_s);

  [[nodiscard]] dmat4 world_from_camera() const;

 private:
  void move_about_pivot(const FlyInput& input);
  void set_direction(double heading, double tilt);

  dvec3 position_ = dvec3(0.0);
  double heading_ = 0.0;  ///< radians about +Y, 0 looks along −Z
  double tilt_ = 0.0;     ///< radians above the horizon
};

/// The camera pose of a view: follows the scene's camera until the user moves it, then a FlyCamera. Lens and effects
/// stay those of the scene's camera.
class ViewFlight {
 public:
  /// Moves the view. The first movement starts at the current pose of the world's camera.
  void advance(const World& world, const FlyInput& input, double dt_s, ViewSettings& settings);

  /// Flies within kJourneyS, from the view's pose, to `eye`, from which it looks at `target`. Input of the user ends
  /// it.
  void fly_to(const World& world, const dvec3& eye, const dvec3& target, ViewSettings& settings);

 private:
  static constexpr double kJourneyS = 0.6;
  struct Journey {
    dvec3 from_eye;
    dvec3 from_target;
    dvec3 eye;
    dvec3 target;
    double gone_s = 0.0;
  };
  void begin(const World& world, ViewSettings& settings);
  void advance_journey(double dt_s);

  std::optional<FlyCamera> camera_;  ///< none until the user flies
  std::optional<Journey> journey_;
};

}  // namespace gloam
