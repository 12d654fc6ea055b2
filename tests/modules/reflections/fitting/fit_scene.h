// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/reflections/fitting/caught_rays.h"
#include "modules/reflections/fitting/planar_regions.h"
#include "modules/reflections/fitting/reflected_rays.h"

/// Shapes for tests of proxy fitting, and a tracer that tries every triangle.
namespace gloam::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A rectangle from `corner` along u and v; its front is at cross(u, v). `steps`: cells a side.
inline FitTriangles rectangle(const dvec3& corner, const dvec3& u, const dvec3& v, std::uint32_t steps = 1) {
  FitTriangles mesh;
  for (std::uint32_t j = 0; j <= steps; ++j)
    for (std::uint32_t i = 0; i <= steps; ++i)
      mesh.positions.push_back(corner + u * (1.0 * i / steps) + v * (1.0 * j / steps));
  const std::uint32_t row = steps + 1;
  for (std::uint32_t j = 0; j < steps; ++j)
    for (std::uint32_t i = 0; i < steps; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
    }
  return mesh;
}

/// A closed box that faces outward, or inward as a room does; one mesh with shared vertices.
inline FitTriangles box(const dvec3& min, const dvec3& max, bool inward = false) {
  FitTriangles mesh;
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                                (i & 4) != 0 ? max.z : min.z);
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads)
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(q[inward ? 3 - corner : corner]);
  return mesh;
}

/// Wall in the plane z = z_m that faces +z.
inline FitTriangles wall(double x, double y, double width, double height, double z_m = 0.0) {
  return rectangle({x, y, z_m}, {width, 0.0, 0.0}, {0.0, height, 0.0});
}

inline FitTriangles sphere(double radius_m, std::uint32_t rings = 24) {
  FitTriangles mesh;
  const double pi = 3.14159265358979323846;
  for (std::uint32_t j = 0; j <= rings; ++j)
    for (std::uint32_t i = 0; i <= 2 * rings; ++i) {
      const double polar = pi * j / rings, around = pi * i / rings;
      mesh.positions.push_back(
          radius_m * dvec3(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around)));
    }
  const std::uint32_t row = 2 * rings + 1;
  for (std::uint32_t j = 0; j < rings; ++j)
    for (std::uint32_t i = 0; i < 2 * rings; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.indices.insert(mesh.indices.end(), {a, a + row + 1, a + row, a, a + 1, a + row + 1});
    }
  return mesh;
}

/// Distance along the ray to the nearest triangle, by Cramer's rule; kNoHit if there is none.
inline double nearest_hit(std::span<const FitTriangles> meshes, const dvec3& origin, const dvec3& direction) {
  double nearest = kNoHit;
  for (const FitTriangles& mesh : meshes)
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const dvec3 a = mesh.positions[mesh.indices[i]];
      const dvec3 ab = mesh.positions[mesh.indices[i + 1]] - a, ac = mesh.positions[mesh.indices[i + 2]] - a;
      const dvec3 p = glm::cross(direction, ac);
      const double determinant = glm::dot(ab, p);
      if (std::abs(determinant) < 1e-14) continue;
      const dvec3 from = origin - a;
      const double u = glm::dot(from, p) / determinant;
      const dvec3 q = glm::cross(from, ab);
      const double v = glm::dot(direction, q) / determinant;
      const double t = glm::dot(ac, q) / determinant;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest) nearest = t;
    }
  return nearest;
}

/// meshes must outlive the tracer.
inline TraceDistances brute_force(std::span<const FitTriangles> meshes) {
  return [meshes](std::span<const dvec3> origins, std::span<const dvec3> directions, std::span<double> hits_m) {
    for (std::size_t i = 0; i < origins.size(); ++i) hits_m[i] = nearest_hit(meshes, origins[i], directions[i]);
  };
}

inline std::vector<UpTriangle> up_triangles(const FitTriangles& mesh) {
  std::vector<UpTriangle> up;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    UpTriangle t;
    for (std::size_t c = 0; c < 3; ++c) t.corners[c] = mesh.positions[mesh.indices[i + c]];
    up.push_back(t);
  }
  return up;
}

/// A proxy of this size that faces `normal`, gravity-aligned; the normal must not be vertical.
inline PlacedProxy proxy_at(const dvec3& center, const dvec3& normal, double width, double height) {
  PlacedProxy proxy;
  proxy.center = center;
  proxy.normal = glm::normalize(normal);
  const dvec3 u = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), proxy.normal));
  proxy.half_u = u * (0.5 * width);
  proxy.half_v = glm::cross(proxy.normal, u) * (0.5 * height);
  return proxy;
}

}  // namespace gloam::test
