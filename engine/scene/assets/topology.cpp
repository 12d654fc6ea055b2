// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/topology.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "engine/core/assert.h"
#include "engine/core/hash.h"

namespace gloam {
namespace {

using Mesh = OpenMesh::TriConnectivity;
using Corners = std::array<std::uint32_t, 3>;
using PositionBits = std::array<std::uint32_t, 3>;

struct PositionHash {
  std::size_t operator()(const PositionBits& bits) const {
    return static_cast<std::size_t>(Hasher().value(bits[0]).value(bits[1]).value(bits[2]).digest());
  }
};

std::uint32_t weld_bits(float value) { return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value); }

/// Fills topology.positions; returns the welded vertex of each input position.
std::vector<std::uint32_t> weld(std::span<const vec3> positions, Topology& topology) {
  std::unordered_map<PositionBits, std::uint32_t, PositionHash> known;
  known.reserve(positions.size());
  std::vector<std::uint32_t> welded;
  welded.reserve(positions.size());
  for (const vec3& p : positions) {
    const PositionBits bits{weld_bits(p.x), weld_bits(p.y), weld_bits(p.z)};
    const auto [found, added] = known.try_emplace(bits, static_cast<std::uint32_t>(topology.positions.size()));
    if (added)
      topology.positions.emplace_back(std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]),
                                      std::bit_cast<float>(bits[2]));
    welded.push_back(found->second);
  }
  return welded;
}

/// Unit normal; false if the face's area is zero or not finite.
bool face_normal(std::span<const vec3> positions, const Corners& face, vec3& normal) {
  const dvec3 a(positions[face[0]]);
  const dvec3 ab = dvec3(positions[face[1]]) - a;
  const dvec3 ac = dvec3(positions[face[2]]) - a;
  const dvec3 cross = glm::cross(ab, ac);
  const double length = glm::length(cross);
  // Below this sine of the angle, the direction is rounding noise of the products.
  constexpr double kSmallestSine = 1.0e-14;
  if (!std::isfinite(length) || !(length > kSmallestSine * glm::length(ab) * glm::length(ac))) return false;
  normal = vec3(cross / length);
  return true;
}

/// Whether a face with the corner from halfedge `in` to `out` would close one fan of faces around their common vertex
/// while the vertex has another fan. Both halfedges exist and are boundaries. OpenMesh walks the same way before it
/// refuses a face.
bool closes_one_of_several_fans(const Mesh& mesh, OpenMesh::HalfedgeHandle in, OpenMesh::HalfedgeHandle out) {
  if (mesh.next_halfedge_handle(in) == out) return false;
  OpenMesh::HalfedgeHandle before = mesh.opposite_halfedge_handle(out);
  do {
    before = mesh.opposite_halfedge_handle(mesh.next_halfedge_handle(before));
  } while (!mesh.is_boundary(before));
  return before == in;
}

/// Whether OpenMesh can add the face. Checked here because OpenMesh reports a refusal on a stream of the whole process.
bool can_add(const Mesh& mesh, const std::array<OpenMesh::VertexHandle, 3>& corners) {
  std::array<OpenMesh::HalfedgeHandle, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!mesh.is_boundary(corners[i])) return false;
    edges[i] = mesh.find_halfedge(corners[i], corners[(i + 1) % 3]);
    if (edges[i].is_valid() && !mesh.is_boundary(edges[i])) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const OpenMesh::HalfedgeHandle out = edges[(i + 1) % 3];
    if (edges[i].is_valid() && out.is_valid() && closes_one_of_several_fans(mesh, edges[i], out)) return false;
  }
  return true;
}

/// Finds the face across each edge of each kept face. The mesh's faces are in the order of topology.faces.
void find_neighbors(const Mesh& mesh, Topology& topology) {
  topology.neighbors.reserve(topology.faces.size());
  for (const Corners& face : topology.faces) {
    Corners across{};
    for (std::size_t i = 0; i < 3; ++i) {
      const OpenMesh::VertexHandle from(static_cast<int>(face[i]));
      const OpenMesh::VertexHandle to(static_cast<int>(face[(i + 1) % 3]));
      const OpenMesh::FaceHandle other = mesh.face_handle(mesh.find_halfedge(to, from));
      across[i] = other.is_valid() ? static_cast<std::uint32_t>(other.idx()) : ~0u;
    }
    topology.neighbors.push_back(across);
  }
}

}  // namespace

Topology build_topology(std::span<const vec3> positions, std::span<const std::uint32_t> indices) {
  GLOAM_ASSERT(indices.size() % 3 == 0, "a triangle list has three indices a face");
  Topology topology;
  const std::vector<std::uint32_t> welded = weld(positions, topology);
  Mesh mesh;
  mesh.reserve(topology.positions.size(), indices.size() / 2, indices.size() / 3);
  for (std::size_t i = 0; i < topology.positions.size(); ++i) mesh.add_vertex();

  for (std::size_t first = 0; first < indices.size(); first += 3) {
    Corners face{};
    std::array<OpenMesh::VertexHandle, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      GLOAM_ASSERT(indices[first + i] < positions.size(), "an index of a triangle list names a position");
      face[i] = welded[indices[first + i]];
      corners[i] = OpenMesh::VertexHandle(static_cast<int>(face[i]));
    }
    vec3 normal;
    if (!face_normal(topology.positions, face, normal)) {
      ++topology.degenerate_faces;
      continue;
    }
    if (!can_add(mesh, corners) || !mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) {
      ++topology.refused_faces;
      continue;
    }
    topology.faces.push_back(face);
    topology.source_faces.push_back(static_cast<std::uint32_t>(first / 3));
    topology.face_normals.push_back(normal);
  }
  find_neighbors(mesh, topology);
  return topology;
}

}  // namespace gloam
