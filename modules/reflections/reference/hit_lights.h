// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/reflections/reference/lobe.h"
#include "modules/reflections/reference/shading.h"
#include "modules/shadows/reference.h"

namespace gloam {

/// Surfaces that rays met, and what they reflect so far. All spans have one item for each ray.
struct HitSurfaces {
  std::span<const TracedSurface> surfaces;
  std::span<const TwinPoint> points;  ///< of surfaces that were hit
  std::span<dvec3> radiance;          ///< toward the rays' origins, cd/m²
};

/// Light of the scene's lights on surfaces that rays met. Lights are shadowed by rays to points of their emitters.
/// Lights share the shadow rays of a surface in proportion to the light that each would add. Not thread-safe.
class HitLights {
 public:
  /// camera: relative to the tracer's origin.
  HitLights(const TwinLights& lights, const SceneTracer& tracer, const dvec3& camera)
      : lights_(lights), tracer_(tracer), camera_(camera) {}

  /// Adds the reflected light of all lights to the radiance. samples: shadow rays for each surface, ≥ 1.
  void add(const HitSurfaces& hits, std::uint32_t samples, const PixelSequence& sequence);

 private:
  /// A light that may reach a surface.
  struct Candidate {
    const TwinLight* light = nullptr;
    dvec3 reflected = dvec3(0.0);
    double up_to = 0.0;  ///< sum of brightness up to this one
  };
  /// Light that one shadow ray carries to a surface if nothing blocks it.
  struct Carried {
    std::uint32_t hit = 0;
    dvec3 light = dvec3(0.0);
  };

  void choose_lights(const HitSurfaces& hits, std::uint32_t hit, std::uint32_t samples, const PixelSequence& sequence);
  void send_shadow_ray(const HitSurfaces& hits, const TwinLight& light, const Carried& carried,
                       const PixelSequence::Pair& on_emitter);
  void add_unblocked_light(std::span<dvec3> radiance);

  const TwinLights& lights_;
  const SceneTracer& tracer_;
  const dvec3 camera_;
  std::vector<Candidate> candidates_;
  BulbRays shadow_rays_;
  std::vector<Carried> carried_;
};

/// Where a ray from a surface begins: above the surface by its error. Positions are relative to the tracer's origin;
/// face_normal: unit, on the ray's side. share: of the point's and the camera's coordinates, see
/// GeometryPicture::error_share.
inline constexpr double kRayStartShare = 4e-5;  // as in traced visibility
[[nodiscard]] inline dvec3 ray_start(const dvec3& position, const dvec3& face_normal, const dvec3& camera,
                                     double share = kRayStartShare) {
  return position + face_normal * (share * (glm::length(position) + glm::length(camera)));
}

}  // namespace gloam
