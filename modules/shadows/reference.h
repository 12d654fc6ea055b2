// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/lights/components.h"

namespace gloam {

/// A light for references: how it lights (shaders/lights/lights_api.glsl, in double), and its emitter. Cookies are left
/// out: their images are files that only the passes of the shadows module load.
struct TwinLight {
  Entity entity = kNoEntity;
  LightKind kind = LightKind::point;
  dvec3 position = dvec3(0.0);         ///< relative to the origin given to gather_lights()
  dvec3 axis = dvec3(0.0, 0.0, -1.0);  ///< unit, the way it shines
  dvec3 color = dvec3(0.0);            ///< candela; directional: lux
  double range2 = 0.0;                 ///< squared range in m²
  double spot_scale = 0.0;
  double spot_offset = 1.0;
  double radius = 0.0;         ///< of the emitter's disc in metres; directional: at distance 1
  double bulb_radius_m = 0.0;  ///< see is_bulb()
  bool casts = true;
  std::uint32_t bulbs = 0;  ///< index in TwinLights::bulbs
};

struct TwinLights {
  std::vector<TwinLight> lights;  ///< all that shine, by entity index
  /// Sets of emissive meshes that do not block their lights, for SceneTracer::occluded(). The first is empty.
  std::vector<std::vector<std::uint32_t>> bulbs;
};

[[nodiscard]] TwinLights gather_lights(const World& world, const SceneTracer& tracer);

/// Illuminance, in lux, at a point on a plane that faces the light, if nothing blocks it. to_light: set to the unit
/// direction to the light.
[[nodiscard]] dvec3 illuminance_of(const TwinLight& light, const dvec3& point, dvec3& to_light);

/// Rounding error of a ray's start and of where it meets a surface, as a share of the coordinates involved.
inline constexpr double kRayRounding = 2e-6;

/// End of a ray to a light, as a share of its length: short of the light by the rounding. distance: from the start to
/// the light; from_origin: from the tracer's origin to the start.
[[nodiscard]] float ray_end(double distance, double from_origin);

/// The segment to a point of the emitter, for SceneTracer::occluded(). start: where the ray begins. x, y: two numbers
/// in [0, 1) that choose the point. Returns false if the light is so near that nothing can block it.
[[nodiscard]] bool aim_at_emitter(const TwinLight& light, const dvec3& start, double x, double y, ShadowRay& ray);

/// Shadow rays to lights with different bulbs, traced together. Not thread-safe.
class BulbRays {
 public:
  void clear();
  /// bulbs: TwinLight::bulbs of the ray's light.
  void add(const ShadowRay& ray, std::uint32_t bulbs);
  /// For each ray, in the order in which they were added: not 0 if something blocks it. Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> blocked(const TwinLights& lights, const SceneTracer& tracer);

 private:
  std::vector<ShadowRay> rays_, batch_;
  std::vector<std::uint32_t> bulbs_;
  std::vector<std::size_t> batch_from_;
  std::vector<std::uint8_t> batch_blocked_, blocked_;
};

}  // namespace gloam
