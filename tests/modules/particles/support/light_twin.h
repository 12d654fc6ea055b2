// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/math/types.h"
#include "modules/particles/baked_light.h"
#include "shaders/particles/particles_shared.h"

/// Light on particles in double precision, for tests.
namespace gloam::test {

inline constexpr double kTwinPi = 3.14159265358979323846;

/// Light for a corner of a sprite is summed at this share of the way from the middle to it.
inline constexpr double kTwinCorner = 0.6;

/// A point light: camera-relative position, candela, range.
struct TwinLamp {
  dvec3 position;
  dvec3 candela;
  double range_m;
};

/// Illuminance of a plane that faces the lamp, in the model of the lights module.
[[nodiscard]] inline dvec3 twin_illuminance(const TwinLamp& lamp, const dvec3& at) {
  const double d = std::max(glm::length(lamp.position - at), 1e-3);
  const double window = std::clamp(1.0 - std::pow(d / lamp.range_m, 4.0), 0.0, 1.0);
  return lamp.candela * (window / (d * d));
}

/// Of the light L from all directions ω a particle scatters albedo ∫ L (1 + n·ω) dω / 4π: here for one direction.
[[nodiscard]] inline dvec3 twin_scattered(const dvec3& albedo, const dvec3& n, const dvec3& to_light,
                                          const dvec3& illuminance) {
  return albedo * illuminance * ((1.0 + glm::dot(n, to_light)) / (4.0 * kTwinPi));
}

/// Particle::outward.
[[nodiscard]] inline dvec3 unpacked_outward(std::uint32_t bits) {
  const auto axis = [&](unsigned shift) { return (static_cast<double>((bits >> shift) & 1023u) - 512.0) / 511.0; };
  return {axis(0), axis(10), axis(20)};
}

/// The direction n at a point of a sprite.
[[nodiscard]] inline dvec3 twin_outward(const shaders::ParticleEmitterRow& e, const shaders::ParticleFrame& frame,
                                        const shaders::Particle& p, double corner_x, double corner_y) {
  const dvec3 bulge = 0.22 * (corner_x * dvec3(frame.right) + corner_y * dvec3(frame.up));
  return static_cast<double>(e.forward) * (unpacked_outward(p.outward) + bulge);
}

}  // namespace gloam::test
