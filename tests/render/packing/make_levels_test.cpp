// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/make_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "engine/render/packing/mesh_packing.h"
#include "engine/render/packing/nearest_surface.h"
#include "tests/render/draws/small_scene.h"

namespace gloam {
namespace {

using Triangle = std::array<dvec3, 3>;

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - a - share * along);
}

/// In double precision, by the sides of the triangle's edges.
double distance_to(const Triangle& t, const dvec3& p) {
  const dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  double least = std::numeric_limits<double>::infinity();
  bool inside = glm::length(normal) > 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 &a = t[k], &b = t[(k + 1) % 3];
    least = std::min(least, distance_to_segment(p, a, b));
    inside = inside && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0;
  }
  if (inside) least = std::min(least, std::abs(glm::dot(p - t[0], normal)) / glm::length(normal));
  return least;
}

double brute_distance(const std::vector<dvec3>& positions, std::span<const std::uint32_t> indices, const dvec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < indices.size(); i += 3)
    least =
        std::min(least, distance_to({positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]}, p));
  return least;
}

/// A closed ball with bumps of that height, one vertex at each place except for the seam of texture coordinates.
Primitive ball(float radius, std::uint32_t rings, float bumps = 0.0f) {
  Primitive p;
  const std::uint32_t sectors = 2 * rings;
  const float pi = 3.14159265f;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t s = 0; s <= sectors; ++s) {
      const float a = pi * static_cast<float>(r) / static_cast<float>(rings);
      const float b = 2.0f * pi * static_cast<float>(s % sectors) / static_cast<float>(sectors);
      const bool pole = r == 0 || r == rings;
      const vec3 way = pole ? vec3(0.0f, r == 0 ? 1.0f : -1.0f, 0.0f)
                            : vec3(std::sin(a) * std::cos(b), std::cos(a), -std::sin(a) * std::sin(b));
      p.positions.push_back((radius + (pole ? 0.0f : bumps * std::sin(9.0f * a) * std::cos(7.0f * b))) * way);
      p.normals.push_back(way);
      p.uv0.push_back({static_cast<float>(s) / static_cast<float>(sectors), a / pi});
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const std::uint32_t i = r * (sectors + 1) + s, below = i + sectors + 1;
      if (r > 0) p.indices.insert(p.indices.end(), {i, below + 1, i + 1});
      if (r + 1 < rings) p.indices.insert(p.indices.end(), {i, below, below + 1});
    }
  return test::finished(std::move(p));
}

/// A tube along y from 0 to 2 that two joints bend at 1, as an elbow.
Primitive arm(std::uint32_t rings) {
  Primitive p;
  constexpr std::uint32_t kSides = 24;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const float y = 2.0f * static_cast<float>(r) / static_cast<float>(rings);
      const float b = 6.2831853f * static_cast<float>(s) / static_cast<float>(kSides);
      p.positions.push_back({0.2f * std::cos(b), y, 0.2f * std::sin(b)});
      p.normals.push_back({std::cos(b), 0.0f, std::sin(b)});
      const float upper = std::clamp(4.0f * (y - 0.875f), 0.0f, 1.0f);
      p.joints.push_back({0, 1, 0, 0});
      p.weights.push_back({1.0f - upper, upper, 0.0f, 0.0f});
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = r * kSides + s, b = r * kSides + (s + 1) % kSides;
      p.indices.insert(p.indices.end(), {a, a + kSides, b, b, a + kSides, b + kSides});
    }
  return test::finished(std::move(p));
}

struct Ordered {
  Primitive mesh;
  std::vector<std::uint32_t> indices;
};
Ordered ordered(const Primitive& source) {
  Ordered made;
  static_cast<void>(build_clusters(source, made.indices));
  made.mesh = in_fetch_order(source, made.indices);
  return made;
}

std::span<const std::uint32_t> indices_of(const MadeLevels& made, const DetailLevel& level) {
  return std::span(made.indices).subspan(level.first_index, level.index_count);
}

/// Open edges by the positions that they join; those of a closed surface cancel.
std::size_t open_edges(const Primitive& mesh, std::span<const std::uint32_t> indices) {
  using Place = std::array<float, 3>;
  const auto place = [&](std::size_t i) {
    const vec3& p = mesh.positions[indices[i]];
    return Place{p.x, p.y, p.z};
  };
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Place a = place(i), b = place(i - i % 3 + (i + 1) % 3);
    a < b ? ++edges[{a, b}] : --edges[{b, a}];
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges.size();
}

TEST(NearestSurface, equals_the_nearest_of_all_triangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  const auto point = [&] { return vec3(place(random), place(random), place(random)); };
  for (const std::size_t triangles : {1u, 3u, 40u, 700u}) {
    std::vector<vec3> positions;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
      positions.push_back(point());
      indices.push_back(static_cast<std::uint32_t>(i));
    }
    for (std::size_t t = 0; t < triangles; t += 5) {
      positions[3 * t + 2] = positions[3 * t];                  // a line
      if (t % 2 == 0) positions[3 * t + 1] = positions[3 * t];  // a point
    }
    std::vector<dvec3> exact(positions.begin(), positions.end());
    const NearestSurface surface(positions, indices);
    for (int i = 0; i < 200; ++i) {
      const vec3 p = (i % 2 == 0 ? 1.0f : 4.0f) * point();
      const NearestSurface::Hit hit = surface.nearest(p);
      EXPECT_NEAR(hit.distance, brute_distance(exact, indices, dvec3(p)), 1e-5);
      vec3 at(0.0f);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(hit.weights[k], 0.0f);
        at += hit.weights[k] * positions[indices[hit.first_index + static_cast<std::uint32_t>(k)]];
      }
      EXPECT_NEAR(glm::length(at - p), hit.distance, 1e-5f);
    }
  }
}

// Hard case: lod.error_bound
TEST(MakeLevels, errors_bound_the_distance_of_all_vertices_at_all_sizes) {
  for (const float size : {0.01f, 1.0f, 100.0f})
    for (const LevelUse use : {LevelUse::maps, LevelUse::views}) {
      const Primitive source = ball(size, 24, 0.05f * size);
      const Ordered full = ordered(source);
      const MadeLevels made = make_levels(source, use);
      ASSERT_GE(made.levels.levels.size(), 3u);
      const std::vector<dvec3> positions(full.mesh.positions.begin(), full.mesh.positions.end());
      std::size_t before = full.indices.size();
      float error = 0.0f;
      for (const DetailLevel& level : made.levels.levels) {
        const auto indices = indices_of(made, level);
        EXPECT_LE(indices.size(), before / 5 * 4);
        EXPECT_GE(level.error, error);
        before = indices.size();
        error = level.error;
        EXPECT_EQ(open_edges(full.mesh, indices), 0u) << "light must not leak in";
        double farthest = 0.0;
        for (const dvec3& p : positions) farthest = std::max(farthest, brute_distance(positions, indices, p));
        EXPECT_GE(level.error, farthest * (1.0 - 1e-4) - 1e-6 * static_cast<double>(size));
        if (use == LevelUse::maps) {
          EXPECT_LE(level.error, farthest * 1.01 + 1e-5 * static_cast<double>(size));
        }
        std::uint32_t in_clusters = 0;
        for (const Cluster& cluster : level.clusters) in_clusters += cluster.index_count;
        EXPECT_EQ(in_clusters, level.index_count);
      }
    }
}

TEST(MakeLevels, for_views_a_bent_texture_counts_as_a_displacement) {
  // A flat sheet whose texture is not linear: the place of the surface does not change, the texture does.
  Primitive sheet;
  constexpr std::uint32_t kSide = 24;
  for (std::uint32_t z = 0; z <= kSide; ++z)
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      const vec2 at(static_cast<float>(x) / kSide, static_cast<float>(z) / kSide);
      sheet.positions.push_back({at.x, 0.0f, at.y});
      sheet.normals.push_back({0.0f, 1.0f, 0.0f});
      sheet.uv0.push_back({at.x * at.x, at.y});
    }
  for (std::uint32_t z = 0; z < kSide; ++z)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t i = z * (kSide + 1) + x;
      sheet.indices.insert(sheet.indices.end(), {i, i + kSide + 1, i + 1, i + 1, i + kSide + 1, i + kSide + 2});
    }
  sheet = test::finished(std::move(sheet));
  const MadeLevels maps = make_levels(sheet, LevelUse::maps), views = make_levels(sheet, LevelUse::views);
  ASSERT_FALSE(maps.levels.levels.empty());
  ASSERT_FALSE(views.levels.levels.empty());
  EXPECT_LT(maps.levels.levels.back().error, 1e-6f);
  EXPECT_GT(views.levels.levels.back().error, 1e-3f);
  for (vec2& uv : sheet.uv0) uv.x = std::sqrt(uv.x);  // linear
  EXPECT_LT(make_levels(sheet, LevelUse::views).levels.levels.back().error, 2e-3f / kSide);
}

dmat4 bent(double degrees, double twist, double scale) {
  const dvec3 elbow(0.0, 1.0, 0.0);
  dmat4 matrix = glm::translate(dmat4(1.0), elbow);
  matrix = glm::rotate(matrix, glm::radians(degrees), dvec3(0.0, 0.0, 1.0));
  matrix = glm::rotate(matrix, glm::radians(twist), dvec3(0.0, 1.0, 0.0));
  return glm::translate(glm::scale(matrix, dvec3(scale)), -elbow);
}

// Hard case: lod.posed_bound
TEST(MakeLevels, posed_errors_bound_skinned_vertices_in_every_pose) {
  const Primitive source = arm(64);
  const Ordered full = ordered(source);
  const MadeLevels made = make_levels(source, LevelUse::maps);
  ASSERT_GE(made.levels.levels.size(), 3u);
  const dmat4 place = glm::rotate(glm::translate(dmat4(1.0), dvec3(3.0, -2.0, 5.0)), 0.7, dvec3(0.6, 0.8, 0.0));
  for (const dmat4& upper : {dmat4(1.0), bent(30.0, 0.0, 1.0), bent(120.0, 40.0, 1.0), bent(-170.0, 90.0, 1.5),
                             glm::translate(dmat4(1.0), dvec3(0.3, 0.5, 0.0))}) {
    const std::array<mat4, 2> joints = {mat4(place), mat4(place * upper)};
    LevelErrors errors{};
    posed_errors(made.levels, joints, std::span(errors).first(made.levels.levels.size()));
    std::vector<dvec3> posed;
    for (std::size_t v = 0; v < full.mesh.positions.size(); ++v) {
      dvec3 sum(0.0);
      for (std::size_t k = 0; k < 2; ++k)
        sum += static_cast<double>(full.mesh.weights[v][static_cast<int>(k)]) *
               dvec3(dmat4(joints[k]) * dvec4(dvec3(full.mesh.positions[v]), 1.0));
      posed.push_back(sum);
    }
    for (std::size_t l = 0; l < made.levels.levels.size(); ++l) {
      double farthest = 0.0;
      for (const dvec3& p : posed)
        farthest = std::max(farthest, brute_distance(posed, indices_of(made, made.levels.levels[l]), p));
      EXPECT_GE(errors[l], farthest - 2e-5) << "level " << l;
    }
  }
  LevelErrors rest{};
  const std::array<mat4, 2> still = {mat4(place), mat4(place)};
  posed_errors(made.levels, still, std::span(rest).first(made.levels.levels.size()));
  for (std::size_t l = 0; l < made.levels.levels.size(); ++l)
    EXPECT_NEAR(rest[l], made.levels.levels[l].error, 1e-5f) << "a rigid motion changes no error";
  posed_errors(made.levels, std::span(still).first(1), std::span(rest).first(made.levels.levels.size()));
  EXPECT_TRUE(std::isinf(rest[0])) << "a joint is missing";
}

TEST(MakeLevels, small_morphing_and_rough_meshes_have_none) {
  EXPECT_TRUE(make_levels(test::box(vec3(1.0f)), LevelUse::maps).levels.levels.empty());
  Primitive morphed = ball(1.0f, 16);
  morphed.morph_targets.push_back({std::vector<vec3>(morphed.positions.size(), vec3(1.0f)), {}});
  EXPECT_TRUE(make_levels(morphed, LevelUse::maps).levels.levels.empty());
  Primitive point = ball(1.0f, 16);
  point.positions.assign(point.positions.size(), vec3(1.0f));
  for (const LevelUse use : {LevelUse::maps, LevelUse::views})
    for (const DetailLevel& level : make_levels(point, use).levels.levels) EXPECT_EQ(level.error, 0.0f);
}

}  // namespace
}  // namespace gloam
