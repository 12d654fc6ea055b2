// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "camera.h"

#include <cmath>

namespace host {

gloam::ViewProjection HostCamera::projection() const {
  const auto near = static_cast<float>(near_m);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return gloam::view_projection(world_from_camera, gloam::reversed_perspective(static_cast<float>(fov_y), aspect, near),
                                near, width, height);
}

dvec3 HostCamera::ray(double x, double y) const {
  const double up = std::tan(0.5 * fov_y);
  const double right = up * width / height;
  const dvec3 seen((2.0 * x / width - 1.0) * right, (1.0 - 2.0 * y / height) * up, -1.0);
  return glm::dmat3(world_from_camera) * seen;
}

HostCamera looking_at(const dvec3& from, const dvec3& to) {
  const dvec3 back = glm::normalize(from - to);
  const dvec3 right = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), back));
  HostCamera camera;
  camera.world_from_camera = dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0),
                                   glm::dvec4(back, 0.0), glm::dvec4(from, 1.0));
  return camera;
}

}  // namespace host
