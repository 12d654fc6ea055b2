// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/mesh_surface.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "engine/core/assert.h"
#include "engine/math/finite.h"
#include "engine/scene/assets/topology.h"

namespace gloam {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Corners of the primitive's triangles that have finite positions.
std::vector<std::uint32_t> finite_triangles(const Primitive& primitive, std::uint32_t& non_finite_faces) {
  std::vector<std::uint32_t> kept;
  kept.reserve(primitive.indices.size());
  for (std::size_t first = 0; first + 3 <= primitive.indices.size(); first += 3) {
    const std::span<const std::uint32_t> face = std::span(primitive.indices).subspan(first, 3);
    bool finite = true;
    for (const std::uint32_t i : face) {
      GLOAM_ASSERT(i < primitive.positions.size(), "an index of a triangle list names a position");
      finite = finite && is_finite(primitive.positions[i]);
    }
    if (finite)
      kept.insert(kept.end(), face.begin(), face.end());
    else
      ++non_finite_faces;
  }
  return kept;
}

/// Number of the edge from `from` to `to` in a face that has it.
std::uint8_t edge_number(const Corners& face, std::uint32_t from, std::uint32_t to) {
  for (std::uint8_t i = 0; i < 3; ++i)
    if (face[i] == from && face[(i + 1u) % 3u] == to) return i;
  return 0;
}

/// Appends the upward-facing triangles of one primitive.
class PrimitiveGrowth {
 public:
  PrimitiveGrowth(const Topology& topology, const dmat4& world_from_mesh, GrowthSurface& surface)
      : topology_(topology),
        axes_{dvec3(world_from_mesh[0]), dvec3(world_from_mesh[1]), dvec3(world_from_mesh[2])},
        mirrored_(glm::dot(glm::cross(axes_[0], axes_[1]), axes_[2]) < 0.0),
        surface_(surface) {}

  void append() {
    std::vector<std::uint32_t> place(topology_.faces.size(), kNoTriangle);
    const std::size_t first = surface_.triangles.size();
    std::vector<std::uint32_t> sources;
    for (std::uint32_t face = 0; face < topology_.faces.size(); ++face) {
      GrowthTriangle triangle;
      if (!set_shape(topology_.faces[face], triangle) || triangle.normal.y < kGrowthCosine) continue;
      place[face] = static_cast<std::uint32_t>(surface_.triangles.size());
      sources.push_back(face);
      surface_.area_m2 += triangle.area_m2;
      surface_.triangles.push_back(triangle);
    }
    for (std::size_t i = 0; i < sources.size(); ++i) connect(sources[i], place, surface_.triangles[first + i]);
  }

 private:
  /// False, and counted, if the triangle has no area or is not finite in the world.
  bool set_shape(const Corners& face, GrowthTriangle& triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 p(topology_.positions[face[i]]);
      triangle.corners[i] = axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z;
    }
    const dvec3 cross =
        glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    const double length = glm::length(cross);
    if (!std::isfinite(length)) {
      ++surface_.non_finite_faces;
      return false;
    }
    triangle.area_m2 = 0.5 * length;
    triangle.normal = vec3(cross / (mirrored_ ? -length : length));
    const bool area = length > 0.0 && is_finite(triangle.normal);
    surface_.degenerate_faces += area ? 0 : 1;
    return area;
  }

  void connect(std::uint32_t face, const std::vector<std::uint32_t>& place, GrowthTriangle& triangle) const {
    const Corners& corners = topology_.faces[face];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t across = topology_.neighbors[face][i];
      triangle.neighbors[i] = across == kNone ? kNoTriangle : place[across];
      if (triangle.neighbors[i] != kNoTriangle)
        triangle.neighbor_edges[i] = edge_number(topology_.faces[across], corners[(i + 1) % 3], corners[i]);
    }
  }

  const Topology& topology_;
  std::array<dvec3, 3> axes_;
  bool mirrored_;
  GrowthSurface& surface_;
};

}  // namespace

GrowthSurface growth_surface(const Mesh& mesh, const dmat4& world_from_mesh) {
  GrowthSurface surface;
  surface.origin = dvec3(world_from_mesh[3]);
  for (const Primitive& primitive : mesh.primitives) {
    const std::vector<std::uint32_t> indices = finite_triangles(primitive, surface.non_finite_faces);
    const Topology topology = build_topology(primitive.positions, indices);
    surface.refused_faces += topology.refused_faces;
    surface.degenerate_faces += topology.degenerate_faces;
    PrimitiveGrowth(topology, world_from_mesh, surface).append();
  }
  return surface;
}

}  // namespace gloam
