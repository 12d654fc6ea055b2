// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"

namespace gloam {

/// A segment that is tested for triangles between its ends.
struct ShadowRay {
  vec3 origin = vec3(0.0f);     ///< relative to SceneTracer::origin()
  vec3 direction = vec3(0.0f);  ///< to the other end, any length
  float from = 0.0f;            ///< start of the segment, as a share of `direction`
  float to = 1.0f;              ///< end of the segment, as a share of `direction`
};

/// A rigid mesh whose material gives light of its own.
struct EmissiveMesh {
  std::uint32_t mesh = 0;  ///< its number, for SceneTracer::occluded()
  dvec3 min = dvec3(0.0);  ///< world-space bounds
  dvec3 max = dvec3(0.0);
  double half_diagonal_m = 0.0;  ///< of the mesh's own box
};

/// The triangles of a world at one moment, for references: skinned and morphed as in the frame, alpha-masked surfaces
/// by their alpha, without blended surfaces and meshes that cast no shadows. Both sides of a triangle block.
/// Thread-safe.
class SceneTracer {
 public:
  virtual ~SceneTracer() = default;
  /// World position that rays are relative to.
  [[nodiscard]] virtual dvec3 origin() const = 0;
  /// Sets blocked[i] to 1 if a triangle lies on rays[i], else to 0. blocked: as many as rays. without: numbers of
  /// emissive meshes, ascending, that the rays pass through.
  virtual void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked,
                        std::span<const std::uint32_t> without = {}) const = 0;
  /// The emissive meshes, ordered by number.
  [[nodiscard]] virtual std::span<const EmissiveMesh> emissive_meshes() const = 0;
  [[nodiscard]] virtual std::uint64_t triangles() const = 0;
  /// Identifies the triangles: the same in every run, different for different triangles.
  [[nodiscard]] virtual std::uint64_t version() const = 0;
};

}  // namespace gloam
