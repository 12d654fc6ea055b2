// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/fly_camera.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kSpeed = 3.0;          // metres per second
constexpr double kMaxTilt = 1.553;      // 89°: at 90° the heading is undefined
constexpr double kNearestPivot = 0.01;  // metres

struct Axes {
  dvec3 right;
  dvec3 up;
  dvec3 back;
};

Axes axes_of(double heading, double tilt) {
  const dvec3 back(std::sin(heading) * std::cos(tilt), -std::sin(tilt), std::cos(heading) * std::cos(tilt));
  const dvec3 right(std::cos(heading), 0.0, -std::sin(heading));
  return {.right = right, .up = glm::cross(back, right), .back = back};
}

}  // namespace

FlyCamera::FlyCamera(const dmat4& world_from_camera) : position_(world_from_camera[3]) {
  const dvec3 back = glm::normalize(dvec3(world_from_camera[2]));
  tilt_ = std::clamp(std::asin(std::clamp(-back.y, -1.0, 1.0)), -kMaxTilt, kMaxTilt);
  heading_ = std::atan2(back.x, back.z);
  // If the camera looks straight up or down, its up axis gives the heading.
  if (std::abs(back.y) > 0.999999) {
    const dvec3 up = dvec3(world_from_camera[1]) * (back.y > 0.0 ? -1.0 : 1.0);
    heading_ = std::atan2(up.x, up.z);
  }
}

void FlyCamera::set_direction(double heading, double tilt) {
  heading_ = std::remainder(heading, 2.0 * std::acos(-1.0));
  tilt_ = std::clamp(tilt, -kMaxTilt, kMaxTilt);
}

void FlyCamera::move_about_pivot(const FlyInput& input) {
  const double distance = glm::distance(input.pivot, position_);
  if (input.look_at_pivot && distance > kNearestPivot) {
    const dvec3 back = (position_ - input.pivot) / distance;
    set_direction(std::atan2(back.x, back.z), std::asin(std::clamp(-back.y, -1.0, 1.0)));
  }
  if (input.orbit_turn != 0.0 || input.orbit_tilt != 0.0) {
    const Axes before = axes_of(heading_, tilt_);
    const dvec3 away = position_ - input.pivot;
    const dvec3 seen(glm::dot(away, before.right), glm::dot(away, before.up), glm::dot(away, before.back));
    set_direction(heading_ + input.orbit_turn, tilt_ - input.orbit_tilt);
    const Axes after = axes_of(heading_, tilt_);
    position_ = input.pivot + after.right * seen.x + after.up * seen.y + after.back * seen.z;
  }
  if (input.approach != 1.0 && distance > 0.0)
    position_ = input.pivot + (position_ - input.pivot) * std::max(input.approach, kNearestPivot / distance);
}

void FlyCamera::advance(const FlyInput& input, double dt_s) {
  move_about_pivot(input);
  set_direction(heading_ + input.turn, tilt_ + input.tilt);
  const Axes axes = axes_of(heading_, tilt_);
  dvec3 movement = axes.right * input.right - axes.back * input.forward + dvec3(0.0, input.up, 0.0);
  const double length = glm::length(movement);
  if (length > 1.0) movement /= length;
  position_ += movement * (kSpeed * input.speed * dt_s);
}

void ViewFlight::begin(const World& world, ViewSettings& settings) {
  if (camera_) return;
  follow_camera(world, settings);
  settings.follow_camera = false;
  camera_ = FlyCamera(settings.world_from_camera);
}

void ViewFlight::fly_to(const World& world, const dvec3& eye, const dvec3& target, ViewSettings& settings) {
  begin(world, settings);
  const dmat4 pose = camera_->world_from_camera();
  const dvec3 from(pose[3]);
  const double distance = std::max(glm::distance(from, target), kNearestPivot);
  journey_ = {.from_eye = from, .from_target = from - dvec3(pose[2]) * distance, .eye = eye, .target = target};
}

void ViewFlight::advance_journey(double dt_s) {
  Journey& journey = *journey_;
  journey.gone_s = std::min(journey.gone_s + dt_s, kJourneyS);
  const double t = journey.gone_s / kJourneyS, share = t * t * (3.0 - 2.0 * t);
  const dvec3 eye = glm::mix(journey.from_eye, journey.eye, share);
  dmat4 pose(1.0);
  pose[3] = dvec4(eye, 1.0);
  camera_ = FlyCamera(pose);
  camera_->advance({.look_at_pivot = true, .pivot = glm::mix(journey.from_target, journey.target, share)}, 0.0);
  if (journey.gone_s == kJourneyS) journey_.reset();
}

void ViewFlight::advance(const World& world, const FlyInput& input, double dt_s, ViewSettings& settings) {
  const bool moved = input.forward != 0.0 || input.right != 0.0 || input.up != 0.0 || input.turn != 0.0 ||
                     input.tilt != 0.0 || input.orbit_turn != 0.0 || input.orbit_tilt != 0.0 || input.approach != 1.0 ||
                     input.look_at_pivot;
  if (moved) {
    begin(world, settings);
    journey_.reset();
  }
  if (!camera_) return;
  if (journey_) advance_journey(dt_s);
  camera_->advance(input, dt_s);
  settings.world_from_camera = camera_->world_from_camera();
}

dmat4 FlyCamera::world_from_camera() const {
  const Axes axes = axes_of(heading_, tilt_);
  return dmat4(dvec4(axes.right, 0.0), dvec4(axes.up, 0.0), dvec4(axes.back, 0.0), dvec4(position_, 1.0));
}

}  // namespace gloam
