// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Shapes as triangle lists in metres. Faces are counter-clockwise seen from outside, normals have unit length, bounds
/// are set, and there are no texture coordinates. Flat faces have hard edges; round faces have smooth normals.

/// Axis-aligned box of the given size, standing on y = 0, centred in x and z.
[[nodiscard]] Primitive box_shape(vec3 size_m);

/// The surface of revolution of an outline about +Y. outline: points (radius, height) from bottom to top, at least 2,
/// radii ≥ 0; a radius of 0 closes an end. sides ≥ 3. Normals are smooth around the axis, with a hard edge at every
/// point of the outline.
[[nodiscard]] Primitive turned_shape(std::span<const vec2> outline, std::uint32_t sides);

[[nodiscard]] Primitive sphere_shape(float radius_m, std::uint32_t sides);

/// A wall in the XY plane with a round arch cut out of its foot, centred in x and z. Both the wall and the arch start
/// at y = 0. radius_m < width_m / 2, radius_m < height_m.
struct ArchSize {
  float width_m = 3.0f;
  float height_m = 2.0f;
  float radius_m = 1.2f;
  float depth_m = 0.5f;
};
[[nodiscard]] Primitive arch_shape(const ArchSize& size, std::uint32_t segments);

/// A rectangle in the XY plane that faces +Z, standing on y = 0, centred in x. It alone has texture coordinates: u
/// along +X, v downwards, each 0…1.
[[nodiscard]] Primitive rectangle_shape(vec2 size_m);

/// Adds the triangles of `part`, moved by offset_m, to `out`. Both have texture coordinates, or neither; an empty `out`
/// takes either. Other optional attributes are not copied.
void append_shape(Primitive& out, const Primitive& part, vec3 offset_m);

}  // namespace gloam
