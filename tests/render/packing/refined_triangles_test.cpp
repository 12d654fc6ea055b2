// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/refined_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
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

/// A town of 2 km: 20,000 small triangles around the origin, and a ground of 2e6 m around it, in a fan of long
/// triangles whose short sides are the town's rim.
Primitive town() {
  constexpr int kCells = 100;
  Primitive p;
  const auto add = [&](double x, double z) {
    p.positions.emplace_back(static_cast<float>(x), 0.0f, static_cast<float>(z));
    p.normals.emplace_back(0.0f, 1.0f, 0.0f);
    return static_cast<std::uint32_t>(p.positions.size() - 1);
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    p.indices.insert(p.indices.end(), {a, b, c});
  };
  std::vector<std::uint32_t> grid;
  for (int z = 0; z <= kCells; ++z)
    for (int x = 0; x <= kCells; ++x) grid.push_back(add(20.0 * x - 1000.0, 20.0 * z - 1000.0));
  const auto at = [&](int x, int z) { return grid[static_cast<std::size_t>(z * (kCells + 1) + x)]; };
  for (int z = 0; z < kCells; ++z)
    for (int x = 0; x < kCells; ++x) {
      triangle(at(x, z), at(x, z + 1), at(x + 1, z + 1));
      triangle(at(x, z), at(x + 1, z + 1), at(x + 1, z));
    }
  const std::array<std::uint32_t, 4> far = {add(-1e6, -1e6), add(-1e6, 1e6), add(1e6, 1e6), add(1e6, -1e6)};
  const auto rim = [&](std::size_t side, int i) {  // counter-clockwise, as the far corners
    return side == 0 ? at(0, i) : side == 1 ? at(i, kCells) : side == 2 ? at(kCells, kCells - i) : at(kCells - i, 0);
  };
  for (std::size_t side = 0; side < 4; ++side) {
    for (int i = 0; i < kCells; ++i) triangle(far[side], rim(side, i + 1), rim(side, i));
    triangle(far[side], far[(side + 1) % 4], rim(side, kCells));
  }
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
      {"a town and its ground", town(), dmat4(1.0), {dvec3(990.0, 1.6, 30.0)}},
      {"a town far from its ground", town(), dmat4(1.0), {dvec3(0.0, 0.9, 30.0)}},
      {"mirrored", flat_quad(1e5f), glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0)), {dvec3(2.0, 0.5, 1.0)}},
  };
}

dvec3 corner(const Primitive& p, std::size_t i, const dvec3& origin, const dmat4& matrix) {
  return dvec3(matrix * dvec4(origin + dvec3(p.positions[p.indices[i]]), 1.0));
}

TEST(RefinedTriangles, must_be_shorter_for_devices_with_few_bits_of_subpixels) {
  EXPECT_EQ(too_long_for(8), kTooLong);
  EXPECT_EQ(too_long_for(16), kTooLong);
  EXPECT_EQ(too_long_for(4), kTooLong / 64.0);
  EXPECT_EQ(too_long_for(0), kTooLong / 64.0) << "Vulkan promises 4";
  const std::vector<dvec3> eyes = {dvec3(0.3, 1.6, -2.0)};
  const Primitive ground = flat_quad(64.0f);
  EXPECT_GT(split_slack(ground, {dmat4(1.0), eyes, kNear}), 0.0);
  const SeenFrom seen{dmat4(1.0), eyes, kNear, too_long_for(4)};
  EXPECT_LT(split_slack(ground, seen), 0.0);
  EXPECT_GT(refined_triangles(ground, seen, eyes[0]).indices.size(), ground.indices.size() + 30);
}

TEST(RefinedTriangles, are_the_same_surface_in_triangles_that_are_short_for_their_distance) {
  for (const LargeCase& c : large_cases()) {
    const SeenFrom seen{c.matrix, c.eyes, kNear};
    ASSERT_LT(split_slack(c.source, seen), 0.0) << c.name;
    const dvec3 origin(glm::inverse(c.matrix) * dvec4(c.eyes[0], 1.0));
    const Primitive made = refined_triangles(c.source, seen, origin);
    const bool fan = c.source.indices.size() > 3000;  // 400 long triangles
    EXPECT_LT(made.indices.size(), c.source.indices.size() + 3u * (fan ? 60000u : 6000u)) << c.name;
    double area = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < made.indices.size(); i += 3) {
      const dvec3 a = corner(made, i, origin, c.matrix), b = corner(made, i + 1, origin, c.matrix),
                  d = corner(made, i + 2, origin, c.matrix);
      double away = std::numeric_limits<double>::infinity();
      for (const dvec3& eye : c.eyes) away = std::min(away, distance_to_triangle(eye, a, b, d));
      const double length = std::max({glm::length(b - a), glm::length(d - b), glm::length(a - d)});
      EXPECT_LE(length, 1.001 * seen.too_long / kSplitShare * std::max(away, kNear)) << c.name;
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

TEST(RefinedTriangles, leave_small_triangles_of_large_meshes_as_they_are) {
  const Primitive source = town();
  const std::vector<dvec3> eyes{dvec3(990.0, 1.6, 30.0)};
  const Primitive made = refined_triangles(source, {dmat4(1.0), eyes, kNear}, eyes[0]);
  std::set<std::array<std::uint32_t, 3>> kept;
  for (std::size_t i = 0; i < made.indices.size(); i += 3)
    kept.insert({made.indices[i], made.indices[i + 1], made.indices[i + 2]});
  std::size_t same = 0;
  for (std::size_t i = 0; i < 3 * 20000; i += 3)
    same += kept.contains({source.indices[i], source.indices[i + 1], source.indices[i + 2]}) ? 1 : 0;
  EXPECT_GT(same, 19500u);  // all but some whose edges on the rim, or near it, are shared with split triangles
}

TEST(RefinedTriangles, are_not_needed_until_an_eye_has_moved_by_the_slack) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int with_slack = 0;
  for (int i = 0; i < 200; ++i) {
    const Primitive source = i % 2 == 0 ? flat_quad(100.0f) : test::box(vec3(50.0f, 3.0f, 900.0f));
    const std::vector<dvec3> eyes{dvec3(90.0 * unit(random), 3.2 + 3.0 * unit(random), 90.0 * unit(random))};
    const double slack = split_slack(source, {dmat4(1.0), eyes, kNear});
    const auto must_split = [&](const dvec3& eye) {
      for (std::size_t t = 0; t < source.indices.size(); t += 3) {
        const auto at = [&](std::size_t k) { return dvec3(source.positions[source.indices[t + k]]); };
        const double length =
            std::max({glm::length(at(1) - at(0)), glm::length(at(2) - at(1)), glm::length(at(0) - at(2))});
        if (length > 1.000001 * kTooLong * std::max(distance_to_triangle(eye, at(0), at(1), at(2)), kNear)) return true;
      }
      return false;
    };
    EXPECT_EQ(must_split(eyes[0]), slack < 0.0) << i;
    if (slack <= 0.0) continue;
    ++with_slack;
    for (int k = 0; k < 50; ++k)
      EXPECT_FALSE(must_split(eyes[0] + glm::normalize(dvec3(unit(random), unit(random), unit(random))) * slack)) << i;
  }
  EXPECT_GT(with_slack, 50);
}

TEST(RefinedTriangles, have_no_cracks) {
  // Each edge but those of the rim is shared by two triangles, with the same corners. Where long triangles meet in a
  // corner far away, edges coincide in floats: as many run one way as the other.
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
      if (c.source.indices.size() <= 3000) {
        EXPECT_EQ(count, 1) << c.name;
      }
      const vec3 p(edge[0], edge[1], edge[2]), q(edge[3], edge[4], edge[5]);
      const auto back = edges.find({q.x, q.y, q.z, p.x, p.y, p.z});
      rim += std::max(0, count - (back == edges.end() ? 0 : back->second)) * glm::length(dvec3(q) - dvec3(p));
    }
    if (is_closed_surface(c.source.positions, c.source.indices)) {
      EXPECT_EQ(rim, 0.0) << c.name;
      EXPECT_TRUE(is_closed_surface(made.positions, made.indices)) << c.name;
    } else {
      const dvec3 size(c.source.bounds.max - c.source.bounds.min);  // of a square in the plane of two axes
      source_rim = 2.0 * (size.x + size.y + size.z);
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
