// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// World-space triangles of one mesh instance.
struct FitTriangles {
  std::vector<dvec3> positions;        ///< metres
  std::vector<std::uint32_t> indices;  ///< three per triangle, each below positions.size()
  bool double_sided = false;           ///< both sides are drawn
};

/// Vertices this near, in metres, are joined.
inline constexpr double kWeld_m = 1e-3;

/// All triangles of a scene, joined at vertices that lie together. Degenerate triangles and triangles with a coordinate
/// that is not finite or beyond 10,000 km are left out.
struct WeldedFaces {
  std::vector<dvec3> positions;                         ///< world, metres
  std::vector<std::array<std::uint32_t, 3>> faces;      ///< counter-clockwise from the front
  std::vector<dvec3> normals;                           ///< unit, one per face
  std::vector<double> areas_m2;                         ///< one per face, > 0
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< face across edge (i, i+1); ~0 at a border
  std::vector<std::uint8_t> double_sided;               ///< one per face, 0 or 1
  [[nodiscard]] const dvec3& corner(std::uint32_t face, std::size_t i) const { return positions[faces[face][i]]; }
};

/// Joins vertices within weld_m of each other, also those of different instances. weld_m: metres, > 0.
[[nodiscard]] WeldedFaces weld_faces(std::span<const FitTriangles> instances, double weld_m);

/// Faces near a plane: the points p with dot(normal, p) = offset_m.
struct PlanarRegion {
  dvec3 normal = dvec3(0.0);  ///< unit length, to the front of the faces
  double offset_m = 0.0;
  double area_m2 = 0.0;
  std::vector<std::uint32_t> faces;
};

/// Bounds between a region's plane and its faces.
struct RegionTolerance {
  double cos_angle = 0.966;  ///< least cosine between normals: 15°
  double distance_m = 0.15;  ///< greatest distance of a vertex
};

/// Grows regions across edges, from the largest face that has none yet. Every face is in one region. Regions come in
/// the order of their first faces' areas.
[[nodiscard]] std::vector<PlanarRegion> grow_planar_regions(const WeldedFaces& faces, const RegionTolerance& tolerance);

/// Most planes that join_coplanar() distinguishes: bounds its time for triangles that share no planes, e.g. leaves.
inline constexpr std::size_t kMostGroups = 4096;

/// Joins regions that share a plane, connected or not: bricks of a wall, a window and the wall around it, two houses in
/// a row. Regions below 1 cm² are left out, and so are the smallest ones beyond kMostGroups planes. Groups come in
/// descending order of their largest regions' areas.
[[nodiscard]] std::vector<PlanarRegion> join_coplanar(const WeldedFaces& faces, std::span<const PlanarRegion> regions,
                                                      const RegionTolerance& tolerance);

}  // namespace gloam
