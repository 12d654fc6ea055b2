// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/readback/picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/reflections/override.h"
#include "modules/reflections/reference/emissive_quad.h"

// The model of the reference that reflections are compared with:
// - Rays begin at the surface under a pixel's centre and follow the GGX lobe of the pixel's shading normal and
//   roughness (ReflectionLobe); a mirror has one ray. Rays below the plane of the drawn triangle are left out. If no
//   ray is left, one follows the mirror direction, moved onto that plane.
// - A surface that a ray meets looks as in a frame, seen from the ray's origin: it has its emission, the reflected
//   light of all lights, diffuse ambient light, and specular surroundings
//   occlusion · specular_share · mix(mirrored_radiance, R, reflectivity), as the composite gives them to pixels. R is
//   traced by further rays along the surface's own lobe. Attributes: see TracedSurface.
// - After ReflectionTracing::bounces surfaces, R is the mirrored radiance of the sky's model.
// - Each ray of a pixel is followed by one ray, chosen in proportion to the lobe's weights (ReflectionLobe::one). If a
//   pixel, or a mirror that it sees, has a single ray, the next surface has as many rays as a rough pixel. Surfaces
//   that show less than 5 % of their surroundings have fewer rays, in proportion.
// - Lights are shadowed by rays to points of their emitters, as in the reference of shadows: a disc of the light's
//   width that faces the point, a clearance before a lamp, bulbs that do not block their lamp. Shadow rays are shared
//   among lights by the light that each would add. A highlight is as wide as its light, as in frames. Cookies are
//   left out (TwinLight), and so is light that passes through bodies.
// - A ray that meets nothing sees the sky. Fog and quads lie along all rays. Blended surfaces are not in the scene.
// Casters without a mesh (grass) and
//   particles are not traced.

namespace gloam {

/// Homogeneous fog along reflected rays.
struct ReflectedFog {
  double density = 0.0;  ///< 1/m; 0: none
  dvec3 color = dvec3(0.0);
  double sky_distance_m = 200.0;  ///< path of rays that see the sky
};

struct ReflectionTracing {
  std::uint32_t rays = 64;          ///< per pixel, ≥ 1; powers of two are spread best
  std::uint32_t light_samples = 1;  ///< shadow rays per ray, ≥ 1; a mirror's one ray gets those of all `rays`
  std::uint32_t bounces = 2;  ///< surfaces that a ray meets, ≥ 1; 2: what a pixel shows has traced reflections, too
  ReflectedFog fog;
  std::span<const EmissiveQuad> quads;  ///< seen by reflected rays only
};

/// Input of trace_radiance(). The world is as the frame's systems left it; the geometry is that frame's.
struct RadianceInput {
  const World& world;
  const GeometryPicture& geometry;
  const SceneTracer& tracer;
  JobExecutor& executor;
  ReflectionTracing settings;
  /// Reports rows of pixels that are done; called by one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

/// The reflected radiance of all pixels with a surface whose reflectivity is above 0. The result depends on the input
/// only, not on the executor.
[[nodiscard]] TracedReflections trace_radiance(const RadianceInput& input);

/// One line that identifies the result of trace_radiance(): the same for the same result.
[[nodiscard]] std::string radiance_identity(const RadianceInput& input);

/// The composite, in double: base + occlusion · specular_share · mix(mirrored_radiance, R, reflectivity) at each pixel
/// with a surface. base: linear light without any specular ambient light (ReflectionOverride::no_specular). Pictures
/// and geometry have the same size. Light that is drawn after the composite (fog, blended surfaces, depth of field) is
/// already in the base, so it does not lie over the result: use it for frames without.
[[nodiscard]] LinearPicture compose_reflections(const LinearPicture& base, const GeometryPicture& geometry,
                                                const World& world, const TracedReflections& traced);

/// base of compose_reflections() from a frame that has its specular ambient light and no reflections: the term is
/// subtracted, as the geometry buffer gives it.
[[nodiscard]] LinearPicture without_specular_ambient(const LinearPicture& lit, const GeometryPicture& geometry,
                                                     const World& world);

}  // namespace gloam
