// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/camera_step.h"

#include <glm/gtc/matrix_transform.hpp>

namespace gloam {

dmat4 moved_camera(const dmat4& world_from_camera, double seen_m, double frames) {
  const dvec3 eye(world_from_camera[3]);
  const dvec3 right = glm::normalize(dvec3(world_from_camera[0]));
  const dmat4 turned = glm::rotate(dmat4(1.0), glm::radians(kTurnDegrees * frames), dvec3(0.0, 1.0, 0.0));
  dmat4 pose = turned * world_from_camera;
  pose[3] = dvec4(eye + right * (seen_m * kStepShare * frames), 1.0);
  return pose;
}

}  // namespace gloam
