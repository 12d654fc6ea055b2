// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/slave_pose.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kSlaveTurn = 0.3;
constexpr double kSlaveTurnSpeed = 1.5;
constexpr double kSlaveFadedBend = 0.6;
constexpr double kCircle = 6.283185307179586;

double hash(std::uint32_t slot) {
  std::uint32_t h = (slot + 1u) * 0x9E3779B1u;
  h = (h ^ h >> 15) * 0x85EBCA77u;
  return ((h ^ h >> 13) & 0xFFFFu) * (2.0 / 65535.0) - 1.0;
}

/// v turned about a unit axis.
dvec3 about(dvec3 axis, double angle, dvec3 v) {
  const double c = std::cos(angle);
  return v * c + glm::cross(axis, v) * std::sin(angle) + axis * (glm::dot(axis, v) * (1.0 - c));
}

}  // namespace

SlaveTurn slave_turn(const SlaveStem& master, const SlaveStem& slave, std::uint32_t slot, dvec3 master_tip,
                     dvec3 rest_tip, double tip_speed) {
  const double length_m = std::max(master.length_m, 1e-6);
  const double bend = std::min(glm::length(master_tip - rest_tip) / (kSlaveFadedBend * length_m), 1.0);
  const double yaw = std::remainder(slave.yaw - master.yaw, kCircle);
  const double angle = yaw * (1.0 - bend * bend * (3.0 - 2.0 * bend)) +
                       kSlaveTurn * hash(slot) * tip_speed / (tip_speed + kSlaveTurnSpeed);
  SlaveTurn turn{};
  for (int i = 0; i < 3; ++i) {
    dvec3 axis(0.0);
    axis[i] = 1.0;
    turn.axes[i] = about(slave.normal, angle, turned(master.normal, slave.normal, axis)) * (slave.length_m / length_m);
  }
  return turn;
}

dvec3 slave_knot(const SlaveTurn& turn, dvec3 master_knot) {
  return turn.axes[0] * master_knot.x + turn.axes[1] * master_knot.y + turn.axes[2] * master_knot.z;
}

}  // namespace gloam
