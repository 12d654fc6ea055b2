// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/blade_solver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/math/packing.h"

namespace gloam {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDragAcceleration = 90.0;
constexpr double kDragSpeed = 10.0;
constexpr double kNominalLength = 0.3;
constexpr double kNominalWidth = 0.006;
constexpr double kRodBend = 290.0;
constexpr double kHeldBend = 260.0;
constexpr double kMostBend = 32400.0;
constexpr double kLimpDamping = 6.0;
constexpr double kDampingRatio = 0.1;
constexpr double kMostJointAngle = 0.314;
constexpr double kModeBend = 160.758;
constexpr double kLengthsPerSecond = 30.0;
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

/// ω² of the blade's slowest swing, 1/s².
double bend_of(const BladeModel& blade) {
  const double stiffness = std::clamp(blade.stiffness, 0.0, 0.999);
  const double shorter = kNominalLength / std::max(blade.length_m, 1e-4);
  const double wider = blade.width_m / kNominalWidth;
  const double bend = stiffness / (1.0 - stiffness) *
                      std::hypot(kRodBend * std::pow(wider * shorter * shorter, 2.0), kHeldBend * shorter);
  return std::min(bend, kMostBend);
}

/// Bending stiffness of the joint below knot k, relative to that at the root: a blade is thinner toward its tip.
double joint_share(std::size_t k) { return static_cast<double>(kGrassKnots - k) / kTip; }

/// The blade's constants for one step length.
struct Constants {
  Segments length_m{};
  Knots direction{};  // at rest, of the segment that ends at the knot
  Segments joint{};   // β of the joint below the knot
  double gain = 0.0;
  double retained = 0.0;
  double drag = 1.0;
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
  const double bend = bend_of(blade);
  const double x2 = bend * frame.step_s * frame.step_s;
  const double damping = std::max({blade.damping, kLimpDamping - std::sqrt(bend), kDampingRatio * std::sqrt(bend)});
  c.retained = std::min(std::exp(-2.0 * damping * frame.step_s) * (1.0 + x2), 1.0);
  c.gain = frame.step_s * frame.step_s * (1.0 + x2);
  for (std::size_t k = 1; k < kGrassKnots; ++k) c.joint[k] = kModeBend * bend * c.gain * joint_share(k);
  c.drag = std::clamp(kNominalWidth / std::max(blade.width_m, 1e-6), 0.25, 4.0);
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
    const double speed = glm::length(air);
    const double eased = speed + kDragSpeed;
    const dvec3 acceleration = frame.pull + air * (c.drag * kDragAcceleration * speed / (eased * eased));
    way[k] = moved * c.retained + acceleration * (c.gain * static_cast<double>(k) / kTip);
  }
  return way;
}

/// Solves (1 + K) x = force for each component, where K is the stiffness of the joints between segments. Gaussian
/// elimination of the band.
Knots solve_bending(const Constants& c, Knots force) {
  Segments diagonal{};
  for (std::size_t k = 1; k < kGrassKnots; ++k) diagonal[k] = 1.0 + c.joint[k] + (k < kTip ? c.joint[k + 1] : 0.0);
  for (std::size_t k = 2; k < kGrassKnots; ++k) {
    const double factor = c.joint[k] / diagonal[k - 1];
    diagonal[k] -= factor * c.joint[k];
    force[k] += factor * force[k - 1];
  }
  for (std::size_t k = kTip; k > 0; --k) {
    if (k < kTip) force[k] += c.joint[k + 1] * force[k + 1];
    force[k] /= diagonal[k];
  }
  return force;
}

/// Brings the knots from where they would move freely, `at`, to where the joints hold them. Segments keep lengths.
void bend(const Constants& c, std::uint32_t iterations, Knots& at) {
  Knots segment{};
  Knots direction{};
  direction[0] = c.direction[0];
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    direction[k] = direction_or(at[k] - at[k - 1], c.direction[k]);
    segment[k] = c.length_m[k] * direction[k];
  }
  for (std::uint32_t i = 0; i < iterations; ++i) {
    Knots force{};
    for (std::size_t k = 1; k < kGrassKnots; ++k) {
      const dvec3 target = c.length_m[k] * turned(c.direction[k - 1], direction[k - 1], c.direction[k]);
      const dvec3 below = k > 1 ? c.length_m[k - 1] * direction[k - 1] - segment[k - 1] : dvec3(0.0);
      const dvec3 strain = c.joint[k] * (segment[k] - target + below);
      force[k] -= strain;
      force[k - 1] += strain;
    }
    const Knots moved = solve_bending(c, force);
    for (std::size_t k = 1; k < kGrassKnots; ++k) direction[k] = direction_or(segment[k] + moved[k], direction[k]);
  }
  for (std::size_t k = 1; k < kGrassKnots; ++k) at[k] = at[k - 1] + c.length_m[k] * direction[k];
}

/// Ends of a collider's axis, or twice its centre.
struct ColliderPlace {
  dvec3 from;
  dvec3 to;
};

ColliderPlace place_of(const shaders::GrassCollider& c, double passed) {
  const auto swept = [&](vec3 before, vec3 now) { return dvec3(before) + (dvec3(now) - dvec3(before)) * passed; };
  return {swept(c.from_previous, c.from), swept(c.to_previous, c.to)};
}

dvec3 push_of(const shaders::GrassCollider& c, const ColliderPlace& place, dvec3 at, dvec3 up) {
  if (c.box != 0) {
    const dvec3 axes[3] = {dvec3(c.axis_x), dvec3(c.axis_y), dvec3(c.axis_z)};
    double least = 0.0;
    dvec3 out(0.0);
    for (int i = 0; i < 3; ++i) {
      const double q = glm::dot(axes[i], at - place.from);
      const double inside = static_cast<double>(c.half_size[i]) - std::abs(q);
      if (inside <= 0.0) return dvec3(0.0);
      if (i > 0 && inside >= least) continue;
      least = inside;
      out = q < 0.0 ? -axes[i] : axes[i];
    }
    return out * least;
  }
  const dvec3 axis = place.to - place.from;
  const double share = std::clamp(glm::dot(at - place.from, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
  const dvec3 away = at - (place.from + share * axis);
  const double depth = static_cast<double>(c.radius_m) - glm::length(away);
  return depth > 0.0 ? direction_or(away, up) * depth : dvec3(0.0);
}

/// When in a step, 0…1, the capsule is nearest to a knot.
double nearest_time(const ColliderPlace& begin, const ColliderPlace& end, dvec3 at) {
  double time = 1.0;
  for (int i = 0; i < 4; ++i) {
    const dvec3 from = glm::mix(begin.from, end.from, time);
    const dvec3 axis = glm::mix(begin.to, end.to, time) - from;
    const double along = std::clamp(glm::dot(at - from, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
    const dvec3 first = glm::mix(begin.from, begin.to, along);
    const dvec3 way = glm::mix(end.from, end.to, along) - first;
    const double way2 = glm::dot(way, way);
    time = way2 > 1e-14 ? std::clamp(glm::dot(at - first, way) / way2, 0.0, 1.0) : 1.0;
  }
  return time;
}

/// The middle of the time in which the box holds a knot; 1 if it never does.
double inside_time(const shaders::GrassCollider& c, dvec3 begin, dvec3 end, dvec3 at) {
  const dvec3 axes[3] = {dvec3(c.axis_x), dvec3(c.axis_y), dvec3(c.axis_z)};
  double first = 0.0;
  double last = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double q = glm::dot(axes[i], at - begin);
    const double v = glm::dot(axes[i], end - begin);
    const auto half = static_cast<double>(c.half_size[i]);
    if (std::abs(v) <= 1e-7) {
      if (std::abs(q) > half) return 1.0;
      continue;
    }
    first = std::max(first, std::min((q - half) / v, (q + half) / v));
    last = std::min(last, std::max((q - half) / v, (q + half) / v));
  }
  return first <= last ? 0.5 * (first + last) : 1.0;
}

void collide(const BladeModel& blade, const BladeSteps& frame, const Constants& c, std::uint32_t step, Knots& at) {
  for (dvec3& knot : at)
    for (const shaders::GrassCollider& collider : frame.colliders) {
      const ColliderPlace begin = place_of(collider, static_cast<double>(step) / frame.frame_steps);
      const ColliderPlace end = place_of(collider, (step + 1.0) / frame.frame_steps);
      const dvec3 up = blade.normal;
      const double time = collider.box != 0 ? inside_time(collider, begin.from, end.from, blade.root + knot)
                                            : nearest_time(begin, end, blade.root + knot);
      const ColliderPlace nearest{glm::mix(begin.from, end.from, time), glm::mix(begin.to, end.to, time)};
      knot += bounded(push_of(collider, nearest, blade.root + knot, up), c.reach_m);
      knot += bounded(push_of(collider, end, blade.root + knot, up), c.reach_m);
    }
}

/// From root to tip: each segment gets its length, no joint folds, and no segment leads below the ground plane.
void restore(const BladeModel& blade, const Constants& c, Knots& at) {
  at[0] = dvec3(0.0);
  dvec3 along = blade.normal;
  double height = 0.0;
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const double length = c.length_m[k];
    const dvec3 held = turned(c.direction[k - 1], along, c.direction[k]);
    along = direction_or(at[k] - at[k - 1], held);
    const dvec3 aside = along - held * glm::dot(along, held);
    if (glm::dot(along, held) < std::cos(kMostJointAngle))
      along = held * std::cos(kMostJointAngle) + direction_or(aside, blade.forward) * std::sin(kMostJointAngle);
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
  blade.damping = static_cast<double>(row.damping);
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
  blade.width_m = static_cast<double>(half_to_float(static_cast<std::uint16_t>(row.size >> 16)));
  set_stem(row.kind >> 8 & 0xFu, 2.0 * static_cast<double>(kPi) * (row.kind & 0xFFu) / 255.0, types, blade);
  return blade;
}

BladeModel blade_model(const GrassBlade& source, std::span<const shaders::GrassTypeRow> types) {
  BladeModel blade;
  blade.root = dvec3(source.root_m);
  blade.normal = dvec3(source.ground_normal);
  blade.length_m = static_cast<double>(source.length_m);
  blade.width_m = static_cast<double>(source.width_m);
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
    for (std::size_t k = 1; k < kGrassKnots; ++k) next[k] += way[k];
    bend(c, frame.iterations, next);
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
  const Constants c = constants_of(blade, {.step_s = step_s});
  const double stiffness = kModeBend * bend_of(blade);  // 1/s²
  double energy = 0.0;
  dvec3 along = c.direction[0];
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    const dvec3 target = c.length_m[k] * turned(c.direction[k - 1], along, c.direction[k]);
    const dvec3 segment = state.at[k] - state.at[k - 1];
    const dvec3 velocity = (state.at[k] - state.before[k]) / step_s;
    energy += 0.5 * glm::dot(velocity, velocity);
    energy += 0.5 * stiffness * joint_share(k) * glm::dot(segment - target, segment - target);
    energy += kGravity * static_cast<double>(k) / kTip * state.at[k].y;
    along = direction_or(segment, along);
  }
  return energy;
}

}  // namespace gloam
