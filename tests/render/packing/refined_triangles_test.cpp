// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/refined_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "engine/render/packing/closed_surface.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

constexpr double kNear = 0.1;

struct LargeCase {
  const char* name;
  Primitive source;
  dmat4 matrix;
  std::vector<dvec3> eyes;
};

Primitive flat_quad(float half) {
  Primitive p = test::quad(half);
  for (vec3& position : p.positions) position = vec3(position.x, 0.0f, -position.y);
  for (vec3& normal : p.normals) normal = vec3(0.0f, 1.0f, 0.0f);
  return test::finished(std::move(p));
}

std::vector<LargeCase> large_cases() {
  const auto at = [](const dvec3& place) { return glm::translate(dmat4(1.0), place); };
  const dmat4 turned = glm::rotate(dmat4(1.0), 0.7, dvec3(0.36, 0.48, 0.8));
  return {
      {"5 km", flat_quad(5e3f), dmat4(1.0), {dvec3(0.3, 1.6, 3.2)}},
      {"1e9 m", flat_quad(1e9f), dmat4(1.0), {dvec3(0.3, 1.6, 3.2)}},
      {"scaled and far",
       flat_quad(1.0f),
       at(dvec3(4e6, 10.0, 2e6)) * turned * glm::scale(dmat4(1.0), dvec3(1e7, 1.0, 3e6)),
       {dvec3(4e6, 14.0, 2e6)}},
      {"two eyes", flat_quad(1e6f), dmat4(1.0), {dvec3(0.0, 1.0, 0.0), dvec3(3e5, 30.0, 2e5)}},
      {"a box around the eye", test::box(vec3(1e7f, 2.0f, 1e6f)), dmat4(1.0), {dvec3(5.0, 0.5, 7.0)}},
      {"an eye in the surface", flat_quad(1e6f), dmat4(1.0), {dvec3(2.0, 0.0, 1.0)}},
      {"mirrored", flat_quad(1e5f), glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0)), {dvec3(2.0, 0.5, 1.0)}},
  };
}

dvec3 corner(const Primitive& p, std::size_t i, const dvec3& origin, const dmat4& matrix) {
  return dvec3(matrix * dvec4(origin + dvec3(p.positions[p.indices[i]]), 1.0));
}

TEST(RefinedTriangles, are_the_same_surface_in_triangles_that_are_short_for_their_distance) {
  for (const LargeCase& c : large_cases()) {
    const SeenFrom seen{c.matrix, c.eyes, kNear};
    ASSERT_GT(longest_ratio(c.source, seen), kTooLong) << c.name;
    const dvec3 origin(glm::inverse(c.matrix) * dvec4(c.eyes[0], 1.0));
    const Primitive made = refined_triangles(c.source, seen, origin);
    EXPECT_LT(made.indices.size(), 3u * 6000u) << c.name;
    double area = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < made.indices.size(); i += 3) {
      const dvec3 a = corner(made, i, origin, c.matrix), b = corner(made, i + 1, origin, c.matrix),
                  d = corner(made, i + 2, origin, c.matrix);
      double away = std::numeric_limits<double>::infinity();
      for (const dvec3& eye : c.eyes) away = std::min(away, distance_to_triangle(eye, a, b, d));
      const double length = std::max({glm::length(b - a), glm::length(d - b), glm::length(a - d)});
      EXPECT_LE(length, 1.001 * kSplitLength * std::max(away, kNear)) << c.name;
      area += 0.5 * glm::length(glm::cross(b - a, d - a));
    }
    for (std::size_t i = 0; i < c.source.indices.size(); i += 3) {
      const dvec3 a = corner(c.source, i, dvec3(0.0), c.matrix);
      whole += 0.5 * glm::length(glm::cross(corner(c.source, i + 1, dvec3(0.0), c.matrix) - a,
                                            corner(c.source, i + 2, dvec3(0.0), c.matrix) - a));
    }
    EXPECT_NEAR(area / whole, 1.0, 1e-5) << c.name;
  }
}

/// Rays from the eye to the made triangles and to the source in double precision.
double hit(const Primitive& p, const dvec3& origin, const dmat4& matrix, const dvec3& eye, const dvec3& way,
           double& facing) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.indices.size(); i += 3) {
    const dvec3 a = corner(p, i, origin, matrix) - eye, b = corner(p, i + 1, origin, matrix) - eye,
                c = corner(p, i + 2, origin, matrix) - eye;
    const double u = glm::dot(way, glm::cross(b, c)), v = glm::dot(way, glm::cross(c, a)),
                 w = glm::dot(way, glm::cross(a, b));
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) || u + v + w == 0.0) continue;
    const double t = (u * glm::dot(a, way) + v * glm::dot(b, way) + w * glm::dot(c, way)) / (u + v + w);
    if (t <= 0.0 || t >= nearest) continue;
    nearest = t;
    facing = u + v + w > 0.0 ? 1.0 : -1.0;
  }
  return nearest;
}

TEST(RefinedTriangles, are_hit_by_rays_where_the_source_is) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const LargeCase& c : large_cases()) {
    if (c.name == std::string("an eye in the surface")) continue;  // each ray begins on it
    const SeenFrom seen{c.matrix, c.eyes, kNear};
    const dvec3 origin(glm::inverse(c.matrix) * dvec4(c.eyes[0], 1.0));
    const Primitive made = refined_triangles(c.source, seen, origin);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
      const dvec3 way = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
      double side = 0.0, own_side = 0.0;
      const double there = hit(c.source, dvec3(0.0), c.matrix, c.eyes[0], way, side);
      const double here = hit(made, origin, c.matrix, c.eyes[0], way, own_side);
      if (!std::isfinite(there)) continue;
      // Corners of the made triangles are floats: at the horizon a ray's hit moves far.
      EXPECT_NEAR(here / there, 1.0, 2e-3) << c.name;
      EXPECT_EQ(side, own_side) << c.name;
      ++hits;
    }
    EXPECT_GT(hits, 100) << c.name;
  }
}

TEST(RefinedTriangles, have_no_cracks) {
  // Each edge but those of the rim is shared by two triangles, with the same corners.
  for (const LargeCase& c : large_cases()) {
    const SeenFrom seen{c.matrix, c.eyes, kNear};
    const dvec3 origin(glm::inverse(c.matrix) * dvec4(c.eyes[0], 1.0));
    const Primitive made = refined_triangles(c.source, seen, origin);
    std::map<std::array<float, 6>, int> edges;
    const auto key = [&](std::uint32_t a, std::uint32_t b) {
      const vec3 &p = made.positions[a], &q = made.positions[b];
      return std::array{p.x, p.y, p.z, q.x, q.y, q.z};
    };
    for (std::size_t i = 0; i < made.indices.size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k) ++edges[key(made.indices[i + k], made.indices[i + (k + 1) % 3])];
    double rim = 0.0, source_rim = 0.0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << c.name;
      const vec3 p(edge[0], edge[1], edge[2]), q(edge[3], edge[4], edge[5]);
      if (!edges.contains({q.x, q.y, q.z, p.x, p.y, p.z})) rim += glm::length(dvec3(q) - dvec3(p));
    }
    if (is_closed_surface(c.source.positions, c.source.indices)) {
      EXPECT_EQ(rim, 0.0) << c.name;
      EXPECT_TRUE(is_closed_surface(made.positions, made.indices)) << c.name;
    } else {
      source_rim = 4.0 * glm::length(dvec3(c.source.positions[1] - c.source.positions[0]));
      EXPECT_NEAR(rim / source_rim, 1.0, 1e-5) << c.name;
    }
  }
}

TEST(RefinedTriangles, keep_attributes) {
  Primitive source = flat_quad(1e6f);
  for (const vec3& position : source.positions) {
    source.colors.push_back(vec4(position.x / 1e6f, 0.5f, position.z / 1e6f, 1.0f));
    source.uv1.push_back(vec2(position.x, position.z));
  }
  const std::vector<dvec3> eyes{dvec3(0.0, 1.6, 0.0)};
  const Primitive made = refined_triangles(source, {dmat4(1.0), eyes, kNear}, eyes[0]);
  ASSERT_EQ(made.colors.size(), made.positions.size());
  for (std::size_t v = 0; v < made.positions.size(); ++v) {
    EXPECT_NEAR(made.colors[v].x, made.positions[v].x / 1e6f, 1e-5f);
    EXPECT_NEAR(made.uv1[v].y, made.positions[v].z, 1e-6f * std::abs(made.positions[v].z) + 1e-3f);
    EXPECT_EQ(made.normals[v], vec3(0.0f, 1.0f, 0.0f));
  }
  EXPECT_EQ(made.material, source.material);
}

}  // namespace
}  // namespace gloam
