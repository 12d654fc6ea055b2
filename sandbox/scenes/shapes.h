// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Triangle lists in metres with outward, counter-clockwise faces, unit normals and bounds; no texture coordinates.
/// Flat faces keep their edges; round ones are smooth.

/// Axis-aligned box of a size, standing on y = 0, centred in x and z.
[[nodiscard]] Primitive box_shape(vec3 size_m);

/// The outline (radius, height), from below to above, turned about +Y: smooth around, an edge at every point of the
/// outline. Points with radius 0 close the ends. outline: at least 2 points, radii ≥ 0. sides ≥ 3.
[[nodiscard]] Primitive turned_shape(std::span<const vec2> outline, std::uint32_t sides);

[[nodiscard]] Primitive sphere_shape(float radius_m, std::uint32_t sides);

/// A wall of `width_m` and `height_m` with a round arch of `radius_m` cut out of its foot, in the XY plane, `depth_m`
/// thick and centred; y = 0 is where the arch springs. radius < width / 2, radius < height.
struct ArchSize {
  float width_m = 3.0f;
  float height_m = 2.0f;
  float radius_m = 1.2f;
  float depth_m = 0.5f;
};
[[nodiscard]] Primitive arch_shape(const ArchSize& size, std::uint32_t segments);

}  // namespace gloam
