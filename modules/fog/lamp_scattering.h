// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/fog/components.h"
#include "modules/shadows/reference.h"

namespace gloam {

/// A ray through the fog.
struct FogRay {
  dvec3 start = dvec3(0.0);      ///< at the camera, relative to SceneTracer::origin()
  dvec3 direction = dvec3(0.0);  ///< unit, away from the camera
  double length = 0.0;           ///< of the path through the fog, finite
};

/// Single scattering of the scene's lights toward the camera, for references. Per metre, fog scatters the share
/// `density` of the light in it. The part of that which does not go forward (1 − kFogForwardShare) goes evenly in all
/// directions. At a point of the ray a light has the illuminance of illuminance_of(), times its transmittance from the
/// light to the point and from the point to the camera. Light of directional lights has passed Fog::sky_distance_m of
/// fog; no other way is longer. The emitter has its width, and rays decide what hides it. Cookies are left out, and
/// light that fog scatters more than once.
///
/// Points on the ray are chosen per light, half of them evenly by the angle at which the light sees the ray (Kulla and
/// Fajardo 2012, "Importance Sampling Techniques for Path Tracing in Participating Media"), half by the transmittance
/// to the camera; the balance heuristic weights them. All points of all lights then share the shadow rays of the pixel
/// in proportion to the light that they would carry: the brightest lights get most of the rays, and the expected value
/// is that of all lights. Deterministic. Not thread-safe.
class LampScattering {
 public:
  /// samples: shadow rays for each pixel, ≥ 1. The lights and the tracer must outlive it.
  LampScattering(const TwinLights& lights, const SceneTracer& tracer, const Fog& fog, std::uint32_t samples);

  /// The light, in cd/m², that the fog on the ray scatters toward its start. pixel: selects the points.
  [[nodiscard]] dvec3 along(const FogRay& ray, std::uint32_t pixel);

 private:
  /// The part of a ray that a light reaches.
  struct LitPart {
    const TwinLight* light = nullptr;
    double begin = 0.0, end = 0.0;
  };
  /// A point of the ray, and what a light's part of it carries to the camera if nothing hides the light.
  struct LitPoint {
    const TwinLight* light = nullptr;
    dvec3 position = dvec3(0.0);
    dvec3 carried = dvec3(0.0);
    double up_to = 0.0;  ///< sum of the brightness of points up to this one
  };

  void find_lit_parts(const FogRay& ray);
  void add_points(const FogRay& ray, const LitPart& part, std::uint32_t count, double shift);
  void add_point(const FogRay& ray, const LitPart& part, double at, double weight);
  void send_shadow_rays(std::uint32_t pixel);
  void add_unblocked();

  const TwinLights& lights_;
  const SceneTracer& tracer_;
  const double density_, longest_path_;
  const std::uint32_t samples_;
  dvec3 light_ = dvec3(0.0);  ///< of the current ray
  std::vector<LitPart> parts_;
  std::vector<LitPoint> points_;
  BulbRays rays_;
  std::vector<dvec3> carried_;  ///< by each of them, if nothing blocks it
};

struct FogRaysInput {
  const World& world;
  const GeometryPicture& geometry;
  const SceneTracer& tracer;
  JobExecutor& executor;
  std::uint32_t samples = 1;
  /// Reports rows of pixels that are done, from one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

/// LampScattering::along() the ray of each pixel; all 0 without fog.
[[nodiscard]] std::vector<dvec3> scatter_lamps(const FogRaysInput& input, const Fog& fog);

/// Path lengths through the fog, one per pixel, from the camera or its plane to the surface; infinite for the sky.
[[nodiscard]] std::vector<double> fog_distances(const GeometryPicture& geometry);

}  // namespace gloam
