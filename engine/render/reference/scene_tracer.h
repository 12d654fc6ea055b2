// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"

namespace gloam {

/// A segment; what lies on it between its ends is asked for.
struct ShadowRay {
  vec3 origin = vec3(0.0f);     ///< relative to SceneTracer::origin()
  vec3 direction = vec3(0.0f);  ///< to the other end, any length
  float from = 0.0f;            ///< share of `direction` where the segment begins
  float to = 1.0f;              ///< and where it ends
};

/// The triangles of a world at one moment, for references: skinned and morphed as the frame shows them, cut-outs by
/// their alpha, blended surfaces left out, both sides of every triangle. Safe from many threads.
class SceneTracer {
 public:
  virtual ~SceneTracer() = default;
  /// World position that rays are relative to.
  [[nodiscard]] virtual dvec3 origin() const = 0;
  /// blocked[i]: 1 when anything lies on rays[i]. As many as rays.
  virtual void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked) const = 0;
  [[nodiscard]] virtual std::uint64_t triangles() const = 0;
  /// Another one for other triangles; the same in every run.
  [[nodiscard]] virtual std::uint64_t version() const = 0;
};

}  // namespace gloam
