// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/bounds.h"

#include <algorithm>
#include <cmath>

#include "modules/particles/emitters/kinds.h"
#include "shaders/particles/particles_shared.h"

namespace gloam {
namespace {

/// Greatest component along a unit axis of a unit vector within `spread` of a vector whose component there is c.
double greatest_cos(double c, double spread) {
  return std::cos(std::max(std::acos(std::clamp(c, -1.0, 1.0)) - spread, 0.0));
}

}  // namespace

float largest_sprite_m(const ParticleEmitter& emitter) {
  return emitter.size_m * GLOAM_PARTICLE_LARGEST * std::max(kind_properties(emitter.kind).growth, 1.0f);
}

WorldBox emitter_bounds(const PlacedEmitter& emitter) {
  const KindProperties kind = kind_of(emitter.values);
  const double life = static_cast<double>(emitter.values.lifetime_s), drag = static_cast<double>(kind.drag);
  // Without turbulence, the way of a particle is v₀ · way + rise · (life − way). It ends on the path of an older one.
  const double way = (1.0 - std::exp(-drag * life)) / drag;
  const double fastest = static_cast<double>(emitter.values.speed) * static_cast<double>(GLOAM_PARTICLE_FASTEST);
  // Half of the diagonal of a square sprite.
  const double corner = 0.5 * std::sqrt(2.0) * static_cast<double>(emitter.largest_m);
  const double margin = static_cast<double>(kind.turbulence) * life + corner;
  WorldBox box;
  for (int i = 0; i < 3; ++i) {
    double half = 0.0;
    for (const vec3& edge : emitter.box) half += 0.5 * std::abs(static_cast<double>(edge[i]));
    const double c = static_cast<double>(emitter.axis[i]), spread = static_cast<double>(emitter.values.spread);
    const double rise = i == 1 ? static_cast<double>(kind.rise) * (life - way) : 0.0;
    const double up = std::max(fastest * greatest_cos(c, spread), 0.0) * way + std::max(rise, 0.0);
    const double down = std::max(fastest * greatest_cos(-c, spread), 0.0) * way + std::max(-rise, 0.0);
    box.min[i] = emitter.origin[i] - half - down - margin;
    box.max[i] = emitter.origin[i] + half + up + margin;
    const double rounding = 1e-5 * (box.max[i] - box.min[i]);  // of the floats of the GPU
    box.min[i] -= rounding;
    box.max[i] += rounding;
  }
  return box;
}

}  // namespace gloam
