// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/bulbs.h"

#include <algorithm>
#include <cmath>

namespace gloam {

double bulb_radius(const Light& light) {
  if (light.kind == LightKind::directional) return -1.0;
  const double radius = std::isfinite(light.width_m) ? 0.5 * static_cast<double>(light.width_m) : 0.0;
  return std::max(radius, kLeastBulb * static_cast<double>(effective_range(light)));
}

bool is_bulb(const dvec3& light, double bulb_radius_m, const dvec3& min, const dvec3& max, double half_diagonal_m) {
  if (bulb_radius_m < 0.0 || !(half_diagonal_m > 0.0)) return false;
  const dvec3 away = light - glm::clamp(light, min, max);
  const double distance = kBulbDistance * bulb_radius_m;
  return glm::dot(away, away) <= distance * distance && half_diagonal_m <= kBulbReach * bulb_radius_m;
}

}  // namespace gloam
