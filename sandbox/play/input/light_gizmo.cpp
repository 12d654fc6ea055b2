// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_gizmo.h"

#include <algorithm>
#include <array>

#include "sandbox/play/input/view_projection.h"

namespace gloam {
namespace {

constexpr double kShareOfDistance = 0.15;  // of the distance from the camera: length of an axis
constexpr double kReach = 9.0;             // pixels around a mark in which the pointer takes it
constexpr std::array<dvec3, 3> kAxes = {dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)};
constexpr std::array<std::array<std::uint8_t, 3>, 3> kColors = {{{240, 90, 80}, {110, 220, 90}, {90, 140, 255}}};
constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};

/// Directional lights shine from everywhere: their gizmo stands before the camera.
dvec3 origin_of(const LightControls& lights, std::size_t light, const ViewSettings& view) {
  constexpr double kBeforeCamera = 4.0;
  if (lights.lights()[light].kind != LightKind::directional) return lights.position(light);
  return dvec3(view.world_from_camera * dvec4(0.0, 0.0, -kBeforeCamera, 1.0));
}

double axis_length(const dvec3& origin, const ViewSettings& view) {
  return std::max(kShareOfDistance * glm::distance(origin, dvec3(view.world_from_camera[3])), 1e-3);
}

double distance_to_segment(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 along = to - from;
  const double squared = glm::dot(along, along);
  const double t = squared > 0.0 ? std::clamp(glm::dot(point - from, along) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(point, from + along * t);
}

}  // namespace

int LightGizmo::part_at(const LightControls& lights, std::size_t light, const ViewSettings& view,
                        const glm::dvec2& pointer) const {
  const ControlledLight& own = lights.lights()[light];
  const dvec3 origin = origin_of(lights, light, view);
  const double length = axis_length(origin, view);
  if (own.kind != LightKind::point) {
    const auto aim = place_in_picture(view, origin + lights.direction(light) * (1.6 * length));
    if (aim && glm::distance(*aim, pointer) <= kReach) return kAim;
  }
  const auto from = place_in_picture(view, origin);
  if (!from || own.kind == LightKind::directional) return kNothing;
  int nearest = kNothing;
  double least = kReach;
  for (int axis = 0; axis < 3; ++axis) {
    const auto to = place_in_picture(view, origin + kAxes[static_cast<std::size_t>(axis)] * length);
    if (!to) continue;
    const double distance = distance_to_segment(pointer, *from + (*to - *from) * 0.2, *to);
    if (distance > least) continue;
    least = distance;
    nearest = axis;
  }
  return nearest;
}

void LightGizmo::drag(LightControls& lights, std::size_t light, const ViewSettings& view, const glm::dvec2& pointer) {
  const SightLine sight = sight_line(view, pointer);
  if (part_ == kAim) {
    const dvec3 origin = origin_of(lights, light, view);
    const dvec3 aim = origin + lights.direction(light) * (1.6 * length_);
    const auto now = in_facing_plane(view, sight, aim);
    if (now && glm::distance(*now, origin) > 1e-6) lights.aim(light, *now - origin);
    return;
  }
  const dvec3& axis = kAxes[static_cast<std::size_t>(part_)];
  if (const auto along = nearest_on_axis(sight, start_, axis)) lights.move(light, start_ + axis * (*along - grabbed_));
}

bool LightGizmo::steer(LightControls& lights, std::size_t light, const ViewSettings& view, const glm::dvec2& pointer,
                       bool down, bool free) {
  const bool pressed = down && !was_down_;
  was_down_ = down;
  if (light >= lights.lights().size() || !lights.lights()[light].movable || !down) {
    const bool ends = part_ != kNothing;
    part_ = kNothing;
    return ends;  // the end of a drag is no click on the picture
  }
  if (pressed && free) {
    part_ = part_at(lights, light, view, pointer);
    start_ = origin_of(lights, light, view);
    length_ = axis_length(start_, view);
    if (part_ >= 0 && part_ < 3)
      grabbed_ =
          nearest_on_axis(sight_line(view, pointer), start_, kAxes[static_cast<std::size_t>(part_)]).value_or(0.0);
    return part_ != kNothing;
  }
  if (part_ == kNothing) return false;
  drag(lights, light, view, pointer);
  return true;
}

std::vector<PanelMark> LightGizmo::marks(const LightControls& lights, std::size_t light,
                                         const ViewSettings& view) const {
  std::vector<PanelMark> marks;
  if (light >= lights.lights().size()) return marks;
  const ControlledLight& own = lights.lights()[light];
  const dvec3 origin = origin_of(lights, light, view);
  const double length = axis_length(origin, view);
  const auto middle = place_in_picture(view, origin);
  if (!middle) return marks;
  marks.push_back({.shape = PanelMark::Shape::circle, .from = *middle, .color = {255, 220, 120}, .label = own.name});
  if (!own.movable) return marks;
  for (std::size_t axis = 0; axis < 3 && own.kind != LightKind::directional; ++axis) {
    const auto to = place_in_picture(view, origin + kAxes[axis] * length);
    if (to) marks.push_back({.from = *middle, .to = *to, .color = kColors[axis], .label = kNames[axis]});
  }
  if (own.kind == LightKind::point) return marks;
  if (const auto aim = place_in_picture(view, origin + lights.direction(light) * (1.6 * length))) {
    marks.push_back({.from = *middle, .to = *aim, .color = {255, 220, 120}});
    marks.push_back({.shape = PanelMark::Shape::square, .from = *aim, .color = {255, 220, 120}, .label = "aim"});
  }
  return marks;
}

}  // namespace gloam
