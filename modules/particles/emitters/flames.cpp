// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/flames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/ecs/view.h"
#include "modules/particles/emitters/bounds.h"
#include "modules/particles/emitters/kinds.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {
namespace {

constexpr int kAges = 48;
/// Mean of sprite_shape.glsl over a disc.
constexpr double kDiscMean = 0.25;

/// The sprites of one age: an ellipse in the rectangle of the flame.
struct Puff {
  double height_m = 0.0;  ///< of its middle above the node
  double half_width_m = 0.0;
  double half_height_m = 0.0;
  double radius_m = 0.0;
  double opacity = 0.0;
  dvec3 emission = dvec3(0.0);
};

double smooth(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// age: share of the lifetime.
Puff puff_at(const ParticleEmitter& e, const KindProperties& kind, double age) {
  const double time = age * static_cast<double>(e.lifetime_s), drag = static_cast<double>(kind.drag);
  const double way = (1.0 - std::exp(-drag * time)) / drag, speed = static_cast<double>(e.speed);
  const double spread = std::min(static_cast<double>(e.spread), 1.5);
  Puff puff;
  puff.radius_m = 0.5 * static_cast<double>(e.size_m) * (1.0 + age * (static_cast<double>(kind.growth) - 1.0));
  puff.height_m = speed * std::cos(0.6 * spread) * way + static_cast<double>(kind.rise) * (time - way);
  const double sideways = 0.5 * speed * std::sin(spread) * way + 0.25 * static_cast<double>(kind.turbulence) * time;
  puff.half_width_m = puff.radius_m + sideways + 0.45 * static_cast<double>(std::max(e.box_m.x, e.box_m.z));
  puff.half_height_m = puff.radius_m + 0.3 * speed * way + 0.5 * static_cast<double>(e.box_m.y);
  puff.opacity = static_cast<double>(kind.opacity) * smooth(age / static_cast<double>(kind.fade_in)) *
                 smooth((1.0 - age) / static_cast<double>(kind.fade_out));
  puff.emission = dvec3(kind.emission) * glm::mix(dvec3(1.0), dvec3(kind.cooled), age * age);
  return puff;
}

std::vector<Puff> puffs_of(const ParticleEmitter& emitter) {
  std::vector<Puff> puffs;
  const KindProperties kind = kind_of(emitter);
  for (int i = 0; i < kAges; ++i) puffs.push_back(puff_at(emitter, kind, (i + 0.5) / kAges));
  return puffs;
}

/// The emitter at a node of no rotation, with its values in their ranges.
std::optional<ParticleEmitter> usable(const ParticleEmitter& emitter) {
  PlacedEmitter placed;
  if (emitter.kind != EmitterKind::fire || !emits(emitter)) return std::nullopt;
  if (!place_emitter(kNoEntity, emitter, dmat4(1.0), placed) || !(placed.largest_m > 0.0f)) return std::nullopt;
  return placed.values;
}

}  // namespace

std::optional<Flame> flame_of(Entity entity, const ParticleEmitter& emitter) {
  const auto values = usable(emitter);
  if (!values) return std::nullopt;
  double half_width = 0.0, low = 0.0, high = 0.0;
  for (const Puff& puff : puffs_of(*values)) {
    half_width = std::max(half_width, puff.half_width_m);
    low = std::min(low, puff.height_m - puff.half_height_m);
    high = std::max(high, puff.height_m + puff.half_height_m);
  }
  return Flame{entity, vec2(2.0 * half_width, high - low), static_cast<float>(0.5 * (low + high))};
}

std::vector<vec4> flame_picture(const ParticleEmitter& emitter, std::uint32_t side) {
  std::vector<vec4> picture(std::size_t{side} * side, vec4(0.0f));
  const auto flame = flame_of(kNoEntity, emitter);
  if (!flame) return picture;
  const ParticleEmitter values = *usable(emitter);
  const KindProperties& kind = kind_properties(values.kind);
  const std::vector<Puff> puffs = puffs_of(values);
  const double sprites = static_cast<double>(values.rate) * static_cast<double>(values.lifetime_s) / kAges;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) {
      const double x = ((column + 0.5) / side - 0.5) * static_cast<double>(flame->size_m.x);
      const double y =
          static_cast<double>(flame->middle_m) + (0.5 - (row + 0.5) / side) * static_cast<double>(flame->size_m.y);
      dvec3 light(0.0);
      double depth = 0.0;  // optical
      for (const Puff& puff : puffs) {
        const double u = x / puff.half_width_m, v = (y - puff.height_m) / puff.half_height_m;
        const double inside = std::max(1.0 - u * u - v * v, 0.0);
        // Number of sprites over this point times their opacity; the profile's mean over the ellipse is 1.
        const double area = puff.radius_m * puff.radius_m / (puff.half_width_m * puff.half_height_m);
        const double alpha = sprites * area * kDiscMean * puff.opacity * 3.0 * inside * inside;
        light += puff.emission * alpha;
        depth += static_cast<double>(kind.cover) * alpha;
      }
      const double hidden = 1.0 - std::exp(-depth);
      picture[std::size_t{row} * side + column] =
          vec4(vec3(light * (depth > 1e-9 ? hidden / depth : 1.0)), static_cast<float>(hidden));
    }
  return picture;
}

FlameSource particle_flames() {
  FlameSource source;
  source.find = [](const World& world) {
    std::vector<Flame> flames;
    world.view<const ParticleEmitter>().each([&](Entity entity, const ParticleEmitter& emitter) {
      if (const auto flame = flame_of(entity, emitter)) flames.push_back(*flame);
    });
    std::ranges::sort(flames, {}, [](const Flame& flame) { return flame.entity.index; });
    return flames;
  };
  source.picture = [](const World& world, Entity entity, std::uint32_t side) {
    const ParticleEmitter* emitter = world.try_get<ParticleEmitter>(entity);
    return flame_picture(emitter != nullptr ? *emitter : ParticleEmitter{}, side);
  };
  return source;
}

}  // namespace gloam
