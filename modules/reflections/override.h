// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// World resource: changes what the composite of reflections adds to opaque surfaces, for references. Absent: nothing.
enum class ReflectionOverride : std::uint8_t {
  none,
  no_specular,  ///< adds nothing: the frame lacks exactly occlusion · specular_ambient() and all reflections
};

/// Traced radiance of a view's pixels.
struct TracedPixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 0;    ///< rays per pixel
  std::vector<float> radiance;  ///< rgba rows from the top: cd/m², and 1 where rays were traced; 0 elsewhere
  std::uint64_t version = 0;    ///< hash of size and radiance

  [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
};

/// Reflected radiance, traced. As a world resource it takes the place of the radiance that the tiers give, so that the
/// frame differs in nothing else.
struct TracedReflections : TracedPixels {};

/// Mean radiance of the hemisphere around each pixel's normal, weighted by the cosine, traced. As a world resource it
/// takes the place of IndirectLight::probes, or of sky and ground, on opaque surfaces.
struct TracedIndirect : TracedPixels {};

}  // namespace gloam
