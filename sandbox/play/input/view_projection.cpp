// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/view_projection.h"

#include <cmath>

namespace gloam {
namespace {

/// Half of the picture's width and height: in metres, or for a perspective camera at a distance of 1 m.
glm::dvec2 half_extent(const ViewSettings& view) {
  const Camera& camera = view.camera;
  if (camera.orthographic) return {camera.half_width_m, camera.half_height_m};
  const double half = std::tan(0.5 * static_cast<double>(camera.fov_y));
  return {half * view.width / view.height, half};
}

}  // namespace

std::optional<glm::dvec2> place_in_picture(const ViewSettings& view, const dvec3& position) {
  const dvec3 seen = dvec3(glm::inverse(view.world_from_camera) * dvec4(position, 1.0));
  if (seen.z > -1e-6) return std::nullopt;
  const glm::dvec2 at = glm::dvec2(seen) / (half_extent(view) * (view.camera.orthographic ? 1.0 : -seen.z));
  return glm::dvec2((0.5 + 0.5 * at.x) * view.width, (0.5 - 0.5 * at.y) * view.height);
}

SightLine sight_line(const ViewSettings& view, const glm::dvec2& place) {
  const glm::dvec2 at(2.0 * place.x / view.width - 1.0, 1.0 - 2.0 * place.y / view.height);
  const glm::dvec2 side = at * half_extent(view);
  const dmat4& pose = view.world_from_camera;
  if (view.camera.orthographic)
    return {.from = dvec3(pose * dvec4(side, 0.0, 1.0)), .direction = glm::normalize(dvec3(pose * dvec4(0, 0, -1, 0)))};
  return {.from = dvec3(pose[3]), .direction = glm::normalize(dvec3(pose * dvec4(side, -1.0, 0.0)))};
}

std::optional<double> nearest_on_axis(const SightLine& sight, const dvec3& origin, const dvec3& axis) {
  const dvec3 away = origin - sight.from;
  const double along = glm::dot(axis, sight.direction);
  const double apart = 1.0 - along * along;
  if (apart < 1e-3) return std::nullopt;
  return (along * glm::dot(sight.direction, away) - glm::dot(axis, away)) / apart;
}

std::optional<dvec3> in_facing_plane(const ViewSettings& view, const SightLine& sight, const dvec3& point) {
  const dvec3 normal = glm::normalize(dvec3(view.world_from_camera[2]));
  const double along = glm::dot(sight.direction, normal);
  if (std::abs(along) < 1e-6) return std::nullopt;
  const double distance = glm::dot(point - sight.from, normal) / along;
  if (distance < 0.0) return std::nullopt;
  return sight.from + sight.direction * distance;
}

}  // namespace gloam
