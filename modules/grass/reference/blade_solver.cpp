// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/blade_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/math/packing.h"

namespace gloam {
namespace {

constexpr double kNominalStep = 1.0 / 120.0;
constexpr double kNominalIterations = 3.0;
constexpr double kGravity = 9.81;
constexpr double kLeastDamping = 2.0;
constexpr double kDragAcceleration = 60.0;
constexpr double kDragSpeed = 20.0;
constexpr double kLengthsPerSecond = 30.0;
constexpr double kLowerPart = 0.25;
constexpr double kShort = 1e-7;
constexpr std::size_t kTip = kGrassKnots - 1;

using Knots = std::array<dvec3, kGrassKnots>;
using Segments = std::array<double, kGrassKnots>;  // [k]: of the segment that ends at knot k

dvec3 direction_or(dvec3 v, dvec3 otherwise) {
  const double length = glm::length(v);
  return length > kShort ? v / length : otherwise;
}

dvec3 bounded(dvec3 v, double most) {
  const double length = glm::length(v);
  return length > most ? v * (most / length) : v;
}

double elasticity(const BladeModel& blade) {
  const double stiffness = std::clamp(blade.stiffness, 0.0, static_cast<double>(0.999f));
  return kNominalIterations * stiffness / (1.0 - stiffness);
}

/// The blade's constants for one step length and number of iterations.
struct Constants {
  Segments length_m{};
  Knots direction{};  // at rest, of the segment that ends at the knot
  double share = 0.0;
  double gain = 1.0;
  double retained = 0.0;
  double reach_m = 0.0;
};

Constants constants_of(const BladeModel& blade, const BladeSteps& frame) {
  Constants c;
  c.direction[0] = blade.normal;
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const dvec3 segment = blade.rest[k] - blade.rest[k - 1];
    c.length_m[k] = glm::length(segment);
    c.direction[k] = direction_or(segment, blade.normal);
  }
  const double nominal = elasticity(blade);
  const double ratio = frame.step_s / kNominalStep;
  const double frequency = std::sqrt(nominal) / kNominalStep;
  const double damped = std::max(kLeastDamping, std::sqrt(2.0) * frequency) * frame.step_s;
  c.retained = std::exp(-damped);
  c.gain = (1.0 - c.retained) / damped;
  const double softness = frame.iterations / (nominal * ratio * ratio * c.gain);
  c.share = nominal > 0.0 ? 1.0 / (1.0 + softness) : 0.0;
  c.reach_m = kLengthsPerSecond * blade.length_m * frame.step_s;
  return c;
}

/// The way of each knot in one step by its velocity and the external accelerations.
Knots predict(const BladeModel& blade, const BladeSteps& frame, const Constants& c, const BladeState& state,
              std::uint32_t step) {
  WindField wind = frame.wind;
  wind.drift += wind.velocity * (frame.step_s * step);
  const dvec3 velocity = wind_velocity(wind, frame.wind_at + blade.root);
  Knots way{};
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const dvec3 moved = bounded(state.at[k] - state.before[k], c.reach_m);
    const dvec3 along = direction_or(state.at[k] - state.at[k - 1], dvec3(0.0));
    dvec3 air = velocity - moved / frame.step_s;
    air -= along * glm::dot(along, air);
    const dvec3 acceleration = dvec3(0.0, -kGravity, 0.0) + air * (kDragAcceleration / (glm::length(air) + kDragSpeed));
    const double weight = static_cast<double>(k) / kTip;
    way[k] = moved * c.retained + acceleration * (c.gain * weight * frame.step_s * frame.step_s);
  }
  return way;
}

/// One stage: the segments that begin at knots first, first + 2, …
void constrain(const Constants& c, std::size_t first, Knots& at) {
  const Knots old = at;
  for (std::size_t low = first; low < kTip; low += 2) {
    const std::size_t high = low + 1;
    const dvec3 segment = old[high] - old[low];
    const double length = glm::length(segment);
    const dvec3 excess = length > kShort ? segment * (1.0 - c.length_m[high] / length) : dvec3(0.0);
    const double lower_part = low > 0 ? kLowerPart : 0.0;
    at[low] += lower_part * excess;
    at[high] -= (1.0 - lower_part) * excess;
    dvec3 target = c.direction[high];
    if (low > 0) {
      const dvec3 below = c.direction[low];
      target = turned(below, direction_or(old[low] - old[low - 1], below), target);
    }
    at[high] += c.share * (at[low] + c.length_m[high] * target - at[high]);
  }
}

dvec3 push_of(const shaders::GrassCollider& c, dvec3 at, dvec3 up, double passed) {
  const auto swept = [&](vec3 before, vec3 now) { return dvec3(before) + (dvec3(now) - dvec3(before)) * passed; };
  const dvec3 from = swept(c.from_previous, c.from);
  if (c.box != 0) {
    const dvec3 axes[3] = {dvec3(c.axis_x), dvec3(c.axis_y), dvec3(c.axis_z)};
    double least = 0.0;
    dvec3 out(0.0);
    for (int i = 0; i < 3; ++i) {
      const double q = glm::dot(axes[i], at - from);
      const double inside = static_cast<double>(c.half_size[i]) - std::abs(q);
      if (inside <= 0.0) return dvec3(0.0);
      if (i > 0 && inside >= least) continue;
      least = inside;
      out = q < 0.0 ? -axes[i] : axes[i];
    }
    return out * least;
  }
  const dvec3 axis = swept(c.to_previous, c.to) - from;
  const double share = std::clamp(glm::dot(at - from, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
  const dvec3 away = at - (from + share * axis);
  const double depth = static_cast<double>(c.radius_m) - glm::length(away);
  return depth > 0.0 ? direction_or(away, up) * depth : dvec3(0.0);
}

void collide(const BladeModel& blade, const BladeSteps& frame, const Constants& c, std::uint32_t step, Knots& at) {
  const double passed = (step + 1.0) / frame.frame_steps;
  for (dvec3& knot : at)
    for (const shaders::GrassCollider& collider : frame.colliders)
      knot += bounded(push_of(collider, blade.root + knot, blade.normal, passed), c.reach_m);
}

/// From root to tip: each segment gets its length, and none leads below the ground plane.
void restore(const BladeModel& blade, const Constants& c, Knots& at) {
  at[0] = dvec3(0.0);
  dvec3 along = blade.normal;
  double height = 0.0;
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const double length = c.length_m[k];
    along = direction_or(at[k] - at[k - 1], along);
    double climb = glm::dot(along, blade.normal);
    if (height + length * climb < 0.0) {
      const dvec3 in_plane = along - blade.normal * climb;
      const dvec3 level = glm::length(in_plane) > 1e-3 ? glm::normalize(in_plane) : blade.forward;
      climb = -height / length;
      along = level * std::sqrt(std::max(1.0 - climb * climb, 0.0)) + blade.normal * climb;
    }
    height = std::max(height + length * climb, 0.0);
    at[k] = at[k - 1] + length * along;
  }
}

}  // namespace

dvec3 turned(dvec3 a, dvec3 b, dvec3 v) {
  const double cosine = glm::dot(a, b);
  if (1.0 + cosine < 5e-7) return v - 2.0 * a * glm::dot(a, v);
  const dvec3 axis = glm::cross(a, b);
  return v * cosine + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1.0 + cosine));
}

dvec3 blade_forward(dvec3 normal, double yaw) {
  const dvec3 up(0.0, 1.0, 0.0);
  return turned(up, normal, dvec3(std::cos(yaw), 0.0, -std::sin(yaw)));
}

namespace {

void set_stem(std::uint32_t type, double yaw, std::span<const shaders::GrassTypeRow> types, BladeModel& blade) {
  blade.forward = blade_forward(blade.normal, yaw);
  const shaders::GrassTypeRow& row = types[std::min<std::size_t>(type, types.size() - 1)];
  blade.stiffness = static_cast<double>(row.stiffness);
  for (std::size_t k = 0; k < kGrassKnots; ++k)
    blade.rest[k] = blade.length_m * (static_cast<double>(row.stem[k].x) * blade.forward +
                                      static_cast<double>(row.stem[k].y) * blade.normal);
}

}  // namespace

BladeModel blade_model(const shaders::GrassPatchRow& patch, const shaders::GrassBladeRow& row,
                       std::span<const shaders::GrassTypeRow> types) {
  const auto share16 = [](std::uint32_t word) { return static_cast<double>(word & 0xFFFFu) / 65535.0; };
  const auto signed8 = [](std::uint32_t word) {
    return std::max(static_cast<float>(static_cast<std::int8_t>(word & 0xFFu)) / 127.0f, -1.0f);
  };
  BladeModel blade;
  const dvec3 in_box(share16(row.root_xz), share16(row.root_y_normal), share16(row.root_xz >> 16));
  blade.root = dvec3(patch.box_from) + dvec3(patch.box_size) * in_box;
  blade.normal = dvec3(octahedral_decode(vec2(signed8(row.root_y_normal >> 16), signed8(row.root_y_normal >> 24))));
  blade.length_m = static_cast<double>(half_to_float(static_cast<std::uint16_t>(row.size & 0xFFFFu)));
  set_stem(row.kind >> 8 & 0xFu, 2.0 * static_cast<double>(kPi) * (row.kind & 0xFFu) / 255.0, types, blade);
  return blade;
}

BladeModel blade_model(const GrassBlade& source, std::span<const shaders::GrassTypeRow> types) {
  BladeModel blade;
  blade.root = dvec3(source.root_m);
  blade.normal = dvec3(source.ground_normal);
  blade.length_m = static_cast<double>(source.length_m);
  set_stem(source.type, static_cast<double>(source.yaw), types, blade);
  return blade;
}

BladeState rest_state(const BladeModel& blade) { return {blade.rest, blade.rest}; }

void advance_blade(const BladeModel& blade, const BladeSteps& frame, std::uint32_t steps, BladeState& state) {
  const Constants c = constants_of(blade, frame);
  const std::uint32_t first = frame.frame_steps - std::min(steps, frame.frame_steps);
  for (std::uint32_t step = first; step < frame.frame_steps; ++step) {
    const Knots way = predict(blade, frame, c, state, step);
    Knots next = state.at;
    for (std::uint32_t i = 0; i < frame.iterations; ++i) {
      for (std::size_t k = 1; k < kGrassKnots; ++k) next[k] += way[k] / static_cast<double>(frame.iterations);
      constrain(c, 0, next);
      constrain(c, 1, next);
    }
    collide(blade, frame, c, step, next);
    restore(blade, c, next);
    state.before = state.at;
    state.at = next;
  }
}

void advance_blades(std::span<const BladeModel> blades, const BladeSteps& frame, JobExecutor& jobs,
                    std::span<BladeState> states) {
  jobs.parallel_for(blades.size(), 64, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) advance_blade(blades[i], frame, frame.frame_steps, states[i]);
  });
}

double blade_energy(const BladeModel& blade, const BladeState& state, double step_s) {
  const double stiffness = elasticity(blade) / (kNominalStep * kNominalStep);  // 1/s²
  double energy = 0.0;
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const dvec3 segment = blade.rest[k] - blade.rest[k - 1];
    dvec3 target = direction_or(segment, blade.normal);
    if (k > 1) {
      const dvec3 below = direction_or(blade.rest[k - 1] - blade.rest[k - 2], blade.normal);
      target = turned(below, direction_or(state.at[k - 1] - state.at[k - 2], below), target);
    }
    const dvec3 strain = state.at[k] - state.at[k - 1] - glm::length(segment) * target;
    const dvec3 velocity = (state.at[k] - state.before[k]) / step_s;
    energy += 0.5 * glm::dot(velocity, velocity) + 0.5 * stiffness * glm::dot(strain, strain);
    energy += kGravity * static_cast<double>(k) / kTip * state.at[k].y;
  }
  return energy;
}

}  // namespace gloam
