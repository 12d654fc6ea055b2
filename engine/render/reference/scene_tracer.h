// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// A segment that is tested for triangles between its ends.
struct ShadowRay {
  vec3 origin = vec3(0.0f);     ///< relative to SceneTracer::origin()
  vec3 direction = vec3(0.0f);  ///< to the other end, any length
  float from = 0.0f;            ///< start of the segment, as a share of `direction`
  float to = 1.0f;              ///< end of the segment, as a share of `direction`
};

/// A ray that looks for the nearest surface.
struct SurfaceRay {
  vec3 origin = vec3(0.0f);                  ///< relative to SceneTracer::origin()
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);  ///< unit length
  float to_m = std::numeric_limits<float>::infinity();
};

/// The surface that a ray meets, evaluated as shaders/render/surface_api.glsl does, with three differences: textures
/// are sampled in mip 0, normal maps are ignored, and numbers are not rounded to the geometry buffer's formats.
struct TracedSurface {
  bool hit = false;  ///< false: the ray meets nothing; nothing else is set then
  bool subsurface = false;
  float distance_m = 0.0f;
  vec3 position = vec3(0.0f);     ///< relative to SceneTracer::origin()
  vec3 face_normal = vec3(0.0f);  ///< unit, on the side that the ray sees
  vec3 normal = vec3(0.0f);       ///< unit, interpolated; on the same side as far as the frame turns normals
  vec3 base_color = vec3(0.0f);   ///< linear
  vec3 emissive = vec3(0.0f);     ///< cd/m²
  float metallic = 0.0f;
  float roughness = 1.0f;
  float occlusion = 1.0f;
  float reflectivity = 0.0f;
};

/// A rigid mesh whose material gives light of its own.
struct EmissiveMesh {
  std::uint32_t mesh = 0;  ///< its number, for SceneTracer::occluded()
  dvec3 min = dvec3(0.0);  ///< world-space bounds
  dvec3 max = dvec3(0.0);
  double half_diagonal_m = 0.0;  ///< of the mesh's own box
};

/// Mesh instances of a tracer: all, or those that are neither skinned nor morphed nor moved by an animation.
enum class TracedInstances : std::uint8_t { all, at_rest };

/// The way of light to a point on the surface of a body, of a ray from that point.
struct BodyPath {
  float inside_m = 0.0f;  ///< metres inside the body; 0 if the ray leaves the body at once
  bool blocked = false;   ///< something else lies on the ray
};

/// The triangles of a world at one moment, for references: skinned and morphed as in the frame, alpha-masked surfaces
/// by their alpha, without blended surfaces. Thread-safe.
class SceneTracer {
 public:
  virtual ~SceneTracer() = default;
  /// World position that rays are relative to.
  [[nodiscard]] virtual dvec3 origin() const = 0;
  /// Sets blocked[i] to 1 if a triangle lies on rays[i], else to 0. Both sides of a triangle block; meshes that cast no
  /// shadows do not. blocked: as many as rays. without: numbers of emissive meshes, ascending, that the rays pass
  /// through.
  virtual void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                        std::span<const std::uint32_t> without = {}) const = 0;
  /// Sets paths[i] to the way along rays[i], which begins on a body and may run through it: the body is the mesh whose
  /// surface the ray leaves first, going out by the winding of its triangles. If it goes into a mesh first, or into or
  /// out of another mesh, it is blocked. Otherwise as occluded(). paths: as many as rays.
  virtual void through_body(std::span<const ShadowRay> rays, std::span<BodyPath> paths,
                            std::span<const std::uint32_t> without = {}) const = 0;
  /// Sets surfaces[i] to the nearest surface on rays[i], of all meshes, also those that cast no shadows. Materials that
  /// are not double-sided have no back, as in frames. surfaces: as many as rays. assets: those of the traced world; its
  /// meshes, materials and images must not have changed since the tracer was made.
  virtual void nearest(const SceneAssets& assets, std::span<const SurfaceRay> rays,
                       std::span<TracedSurface> surfaces) const = 0;
  /// The emissive meshes that cast shadows, ordered by number.
  [[nodiscard]] virtual std::span<const EmissiveMesh> emissive_meshes() const = 0;
  /// Number of triangles that cast shadows.
  [[nodiscard]] virtual std::uint64_t triangles() const = 0;
  /// Identifies the triangles that cast shadows: the same in every run, different for different triangles.
  [[nodiscard]] virtual std::uint64_t version() const = 0;
  /// Identifies all triangles, also those that cast no shadows. Materials, images and vertex attributes do not enter.
  [[nodiscard]] virtual std::uint64_t all_version() const = 0;
};

}  // namespace gloam
