// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/ecs/world.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/particles/bake.h"
#include "modules/particles/components.h"
#include "modules/shadows/components.h"

namespace gloam::test {

/// Nothing but a square wall in the plane x = 0, 2 · half_m wide and high around the origin.
class WallTracer final : public SceneTracer {
 public:
  explicit WallTracer(double half_m, dvec3 origin = dvec3(0.0)) : half_m_(half_m), origin_(origin) {}

  /// Whether the segment between two points of the world crosses the wall.
  [[nodiscard]] bool crosses(const dvec3& a, const dvec3& b) const {
    if ((a.x < 0.0) == (b.x < 0.0)) return false;
    const double t = a.x / (a.x - b.x);
    const dvec3 at = a + t * (b - a);
    return std::abs(at.y) < half_m_ && std::abs(at.z) < half_m_;
  }
  [[nodiscard]] dvec3 origin() const override { return origin_; }
  void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                std::span<const std::uint32_t>) const override {
    traced += rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const dvec3 from = origin_ + dvec3(rays[i].origin);
      const double to = std::isfinite(rays[i].to) ? static_cast<double>(rays[i].to) : 1e4;
      blocked[i] = crosses(from, from + dvec3(rays[i].direction) * to) ? 1 : 0;
    }
  }
  void through_body(std::span<const ShadowRay>, std::span<BodyPath>, std::span<const std::uint32_t>) const override {}
  void nearest(const SceneAssets&, std::span<const SurfaceRay>, std::span<TracedSurface>) const override {}
  [[nodiscard]] std::span<const EmissiveMesh> emissive_meshes() const override { return {}; }
  [[nodiscard]] std::uint64_t triangles() const override { return 2; }
  [[nodiscard]] std::uint64_t version() const override { return triangles_version; }
  [[nodiscard]] std::uint64_t all_version() const override { return triangles_version; }

  std::uint64_t triangles_version = 1;
  mutable std::atomic<std::size_t> traced = 0;

 private:
  double half_m_;
  dvec3 origin_;
};

/// A world of emitters and lights.
struct BakeScene {
  World world;

  BakeScene() {
    prepare_scene_world(world);
    world.register_component<Light>("light");
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<ParticleEmitter>("particle_emitter");
  }
  static WorldTransform placed_at(const dvec3& at) {
    dmat4 matrix(1.0);
    matrix[3] = {at, 1.0};
    return {matrix};
  }
  Entity add_emitter(const dvec3& at, const vec3& box_m = vec3(1.0f)) {
    return world.create(placed_at(at),
                        ParticleEmitter{.kind = EmitterKind::fog, .lifetime_s = 1.0f, .speed = 0.1f, .box_m = box_m});
  }
  Entity add_lamp(const dvec3& at, float candela = 100.0f, float width_m = 0.0f) {
    return world.create(placed_at(at), Light{.intensity = candela, .range_m = 50.0f, .width_m = width_m});
  }
  [[nodiscard]] ParticleLightMaps bake(const SceneTracer& tracer, JobExecutor& executor) const {
    return bake_particle_light({.world = world, .tracer = tracer, .executor = executor});
  }
  [[nodiscard]] ParticleLightMaps bake(const SceneTracer& tracer) const {
    return bake(tracer, *make_serial_executor());
  }
};

}  // namespace gloam::test
