// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/bulbs.h"

#include <algorithm>

namespace gloam {

bool is_bulb(const dvec3& light, double emitter_radius_m, const dvec3& min, const dvec3& max, double half_diagonal_m) {
  if (emitter_radius_m < 0.0 || !(half_diagonal_m > 0.0)) return false;
  const double radius = std::max(emitter_radius_m, kLeastEmitter_m);
  const dvec3 away = light - glm::clamp(light, min, max);
  const double distance = kBulbDistance * radius;
  return glm::dot(away, away) <= distance * distance && half_diagonal_m <= kBulbReach * radius;
}

}  // namespace gloam
