// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/reference/particle_twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gloam {
namespace {

/// A period of this wave is two parabolas.
double twin_wave(double x) {
  const double share = x - std::floor(x);
  return share < 0.5 ? -16.0 * share * (0.5 - share) : 16.0 * (share - 0.5) * (1.0 - share);
}

/// Way without turbulence: the equation of motion dv/dt = drag · (rise − v), integrated in small steps.
dvec3 integrated_way(const shaders::ParticleEmitterRow& e, const dvec3& velocity, double age) {
  const double drag = static_cast<double>(e.drag);
  const dvec3 rise(0.0, static_cast<double>(e.rise), 0.0);
  const int steps = 40 + static_cast<int>(20.0 * drag * age);
  const double h = age / steps;
  dvec3 v = velocity, way(0.0);
  const auto slope = [&](const dvec3& at) { return drag * (rise - at); };
  for (int i = 0; i < steps; ++i) {  // Runge-Kutta of fourth order
    const dvec3 k1 = slope(v), k2 = slope(v + 0.5 * h * k1), k3 = slope(v + 0.5 * h * k2), k4 = slope(v + h * k3);
    way += h * (v + h / 6.0 * (k1 + k2 + k3));
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return way;
}

}  // namespace

std::array<std::uint32_t, 4> twin_lot(std::uint32_t seed, std::uint32_t number, std::uint32_t lot) {
  std::array<std::uint32_t, 4> v = {number, seed, lot, number ^ seed};
  for (std::uint32_t& word : v) word = word * 1664525u + 1013904223u;
  const auto mix = [&v] {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  };
  mix();
  for (std::uint32_t& word : v) word ^= word >> 16;
  mix();
  return v;
}

dvec3 twin_swirl(const dvec3& at, double time) {
  constexpr double kSlowTurns[3] = {7.0, -5.0, 6.0}, kFastTurns[3] = {8.0, 11.0, -10.0};
  constexpr double kSlow[3] = {0.37, 0.71, 0.13}, kFastA[3] = {0.5, 0.1, 0.8}, kFastB[3] = {0.9, 0.2, 0.6};
  dvec3 sum(0.0);
  for (int i = 0; i < 3; ++i) {
    const double next = at[(i + 1) % 3], other = at[(i + 2) % 3];
    sum[i] = 0.34 * (twin_wave(next + kSlowTurns[i] * time) + twin_wave(other + kSlow[i] - 4.0 * time)) +
             0.16 * (twin_wave(2.17 * next + kFastA[i] - 9.0 * time) +
                     twin_wave(2.17 * other + kFastB[i] + kFastTurns[i] * time));
  }
  return sum;
}

TwinParticle twin_particle(const shaders::ParticleEmitterRow& e, std::uint32_t k, const dvec3& nudge) {
  const auto a = twin_lot(e.seed, e.oldest + k, 0), b = twin_lot(e.seed, e.oldest + k, 1);
  TwinParticle p;
  p.age_s = static_cast<double>(e.oldest_age_s) - k * static_cast<double>(e.interval_s);
  const dvec3 birth = (unit_of(a[0]) - 0.5) * dvec3(e.box_x) + (unit_of(a[1]) - 0.5) * dvec3(e.box_y) +
                      (unit_of(a[2]) - 0.5) * dvec3(e.box_z);
  const double cosine = 1.0 + unit_of(b[0]) * (static_cast<double>(e.cos_spread) - 1.0);
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), about = 2.0 * std::numbers::pi * unit_of(b[1]);
  const dvec3 direction =
      cosine * dvec3(e.axis) + sine * (std::cos(about) * dvec3(e.across_x) + std::sin(about) * dvec3(e.across_y));
  const dvec3 velocity = direction * (static_cast<double>(e.speed) * (0.6 + 0.8 * unit_of(b[2])));
  // The flow is linear between the ends of the steps; the end of a step is where the flow at its begin leads.
  const double step = static_cast<double>(e.swirl_step_s);
  const auto flow_at = [&](const dvec3& at, double then) {
    return static_cast<double>(e.turbulence) *
           twin_swirl((at + nudge) * static_cast<double>(e.inverse_swirl),
                      static_cast<double>(e.swirl_time) + (then - p.age_s) / GLOAM_PARTICLE_SWIRL_PERIOD);
  };
  dvec3 drift(0.0), flow = flow_at(birth, 0.0);
  for (double then = 0.0; then < p.age_s; then += step) {
    const dvec3 next = flow_at(birth + integrated_way(e, velocity, then + step) + drift + step * flow, then + step);
    const double past = std::min(p.age_s - then, step);
    const dvec3 last = flow + past / step * (next - flow);
    drift += 0.5 * past * (flow + last);
    flow = next;
  }
  p.life = p.age_s * static_cast<double>(e.inverse_life);
  p.position = dvec3(e.origin) + birth + integrated_way(e, velocity, p.age_s) + drift;
  p.radius_m = 0.5 * static_cast<double>(e.size_m) * (0.75 + 0.5 * unit_of(a[3])) *
               (1.0 + p.life * (static_cast<double>(e.growth) - 1.0));
  p.angle =
      2.0 * std::numbers::pi * unit_of(b[3]) + static_cast<double>(e.spin) * p.age_s * (2.0 * unit_of(b[2]) - 1.0);
  const auto smooth = [](double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  };
  p.opacity = static_cast<double>(e.opacity) * smooth(p.life * static_cast<double>(e.per_fade_in)) *
              smooth((1.0 - p.life) * static_cast<double>(e.per_fade_out));
  return p;
}

}  // namespace gloam
