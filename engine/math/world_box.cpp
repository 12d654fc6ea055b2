// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/world_box.h"

#include <cmath>

#include "engine/math/finite.h"

namespace gloam {

bool WorldBox::known() const {
  return is_finite(min) && is_finite(max) && min.x <= max.x && min.y <= max.y && min.z <= max.z;
}

WorldBox world_box(const Aabb& box, const dmat4& m) {
  const dvec3 middle = (dvec3(box.min) + dvec3(box.max)) * 0.5;
  const dvec3 half = (dvec3(box.max) - dvec3(box.min)) * 0.5;
  const dvec3 center(m * dvec4(middle, 1.0));
  const dvec3 reach = glm::abs(dvec3(m[0])) * half.x + glm::abs(dvec3(m[1])) * half.y + glm::abs(dvec3(m[2])) * half.z;
  return {center - reach, center + reach};
}

double half_diagonal(const Aabb& box, const dmat4& m) {
  const dvec3 half = (dvec3(box.max) - dvec3(box.min)) * 0.5;
  const dvec3 x = dvec3(m[0]) * half.x, y = dvec3(m[1]) * half.y, z = dvec3(m[2]) * half.z;
  return std::sqrt(glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z));
}

}  // namespace gloam
