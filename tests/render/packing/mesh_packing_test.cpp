// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/mesh_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "engine/math/packing.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr std::uint32_t kHandednessBit = 0x10000u;

double angle_degrees(vec3 a, vec3 b) {
  const dvec3 x = glm::normalize(dvec3(a));
  const dvec3 y = glm::normalize(dvec3(b));
  return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180.0 / 3.14159265358979323846;
}

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  [[nodiscard]] float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  [[nodiscard]] vec3 point(float reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] vec3 direction() {
    vec3 v(0.0f);
    while (glm::dot(v, v) < 1e-4f || glm::dot(v, v) > 1.0f) v = point(1.0f);
    return glm::normalize(v);
  }
  [[nodiscard]] std::uint32_t below(std::uint32_t end) {
    return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(engine_);
  }

 private:
  std::mt19937 engine_;
};

std::array<std::uint32_t, 4> weights_of(const PackedInfluence& p) {
  return {p.weights01 & 0xFFFFu, p.weights01 >> 16, p.weights23 & 0xFFFFu, p.weights23 >> 16};
}
std::array<std::uint32_t, 4> joints_of(const PackedInfluence& p) {
  return {p.joints01 & 0xFFFFu, p.joints01 >> 16, p.joints23 & 0xFFFFu, p.joints23 >> 16};
}

TEST(PackFrames, decode_within_a_hundredth_of_a_degree) {
  Random random(1);
  Primitive primitive;
  for (int i = 0; i < 20000; ++i) {
    primitive.positions.push_back(vec3(0.0f));
    primitive.normals.push_back(random.direction());
    primitive.tangents.push_back(vec4(random.direction(), i % 3 == 0 ? -1.0f : 1.0f));
  }
  for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}) {
    for (const float sign : {1.0f, -1.0f}) {
      primitive.positions.push_back(vec3(0.0f));
      primitive.normals.push_back(sign * axis);
      primitive.tangents.push_back(vec4(sign * axis, sign));
    }
  }
  const auto frames = pack_frames(primitive);
  ASSERT_EQ(frames.size(), primitive.positions.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_LT(angle_degrees(unpack_normal_snorm16(frames[i].normal), primitive.normals[i]), 0.01) << i;
    const vec3 tangent = unpack_normal_snorm16(frames[i].tangent & ~kHandednessBit);
    ASSERT_LT(angle_degrees(tangent, vec3(primitive.tangents[i])), 0.01) << i;
    ASSERT_EQ((frames[i].tangent & kHandednessBit) != 0, primitive.tangents[i].w < 0.0f) << i;
  }
}

TEST(PackFrames, without_tangents_there_is_a_right_handed_one) {
  Primitive primitive;
  primitive.positions = {vec3(0.0f)};
  primitive.normals = {vec3(0.0f, 1.0f, 0.0f)};
  const auto frames = pack_frames(primitive);
  EXPECT_EQ(frames[0].tangent & kHandednessBit, 0u);
  EXPECT_NEAR(glm::length(unpack_normal_snorm16(frames[0].tangent)), 1.0f, 1e-5f);
}

/// Value of a half float that is not negative and finite (IEEE 754 binary16).
double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

TEST(PackSurfaces, keep_coordinates_exactly_and_colours_as_half_floats) {
  Random random(2);
  Primitive primitive;
  for (int i = 0; i < 100; ++i) {
    primitive.positions.push_back(vec3(0.0f));
    primitive.uv0.push_back({random.in(-3, 3), random.in(-3, 3)});
    primitive.uv1.push_back({random.in(-3, 3), random.in(-3, 3)});
    primitive.colors.push_back({random.in(0, 1), random.in(0, 1), random.in(0, 1), random.in(0, 1)});
  }
  const auto surfaces = pack_surfaces(primitive);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    EXPECT_EQ(surfaces[i].uv0, primitive.uv0[i]);
    EXPECT_EQ(surfaces[i].uv1, primitive.uv1[i]);
    for (int c = 0; c < 4; ++c) {
      const double value = primitive.colors[i][c];
      EXPECT_NEAR(half_value(surfaces[i].color[static_cast<std::size_t>(c)]), value, value / 2048.0 + 1e-7);
    }
  }
}

TEST(PackSurfaces, what_is_absent_is_zero_coordinates_and_white) {
  Primitive primitive;
  primitive.positions = {vec3(0.0f)};
  const auto surfaces = pack_surfaces(primitive);
  EXPECT_EQ(surfaces[0].uv0, vec2(0.0f));
  EXPECT_EQ(surfaces[0].uv1, vec2(0.0f));
  for (const std::uint16_t channel : surfaces[0].color) EXPECT_EQ(half_value(channel), 1.0);
  primitive.colors = {vec4(2.0f, -1.0f, 0.0f, 1.0f)};
  const auto clamped = pack_surfaces(primitive)[0].color;
  const double expected[] = {1.0, 0.0, 0.0, 1.0};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(half_value(clamped[c]), expected[c]) << "colours are clamped to 0…1";
}

TEST(PackInfluences, weights_sum_to_65535_and_stay_within_two_steps) {
  Random random(3);
  Primitive primitive;
  for (int i = 0; i < 5000; ++i) {
    primitive.positions.push_back(vec3(0.0f));
    std::array<std::uint16_t, 4> joints{};
    for (std::uint16_t& joint : joints) joint = static_cast<std::uint16_t>(random.below(65536));
    primitive.joints.push_back(joints);
    vec4 weights(random.in(0, 1), random.in(0, 1), random.in(0, 1), random.in(0, 1));
    if (i % 3 == 0) weights.w = 0.0f;
    if (i % 5 == 0) weights.y = weights.z = 0.0f;
    primitive.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
  }
  const auto packed = pack_influences(primitive);
  ASSERT_EQ(packed.size(), primitive.positions.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const auto weights = weights_of(packed[i]);
    const auto joints = joints_of(packed[i]);
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += weights[k];
      const double exact = primitive.weights[i][static_cast<int>(k)];
      ASSERT_NEAR(weights[k] / 65535.0, exact, 2.5 / 65535.0) << i;
      ASSERT_TRUE(exact != 0.0 || weights[k] == 0u) << i;
      ASSERT_EQ(joints[k], primitive.joints[i][k]) << i;
    }
    ASSERT_EQ(sum, 65535u) << i;
  }
}

TEST(PackInfluences, odd_weights_sum_to_65535_too) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Primitive primitive;
  for (const vec4 weights : {vec4(0.0f), vec4(1.0f), vec4(2.0f, 1.0f, 1.0f, 0.0f), vec4(0.1f, 0.1f, 0.0f, 0.0f),
                             vec4(-1.0f, 2.0f, 0.0f, 0.0f), vec4(nan, 1.0f, 0.0f, 0.0f),
                             vec4(infinity, 1.0f, 0.0f, 0.0f), vec4(1e-30f, 0.0f, 0.0f, 0.0f)}) {
    primitive.positions.push_back(vec3(0.0f));
    primitive.joints.push_back({1, 2, 3, 4});
    primitive.weights.push_back(weights);
  }
  const auto packed = pack_influences(primitive);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const auto w = weights_of(packed[i]);
    EXPECT_EQ(w[0] + w[1] + w[2] + w[3], 65535u) << "weights " << i;
  }
  EXPECT_EQ(weights_of(packed[0])[0], 65535u) << "no weight at all: the first joint has it";
  EXPECT_NEAR(weights_of(packed[2])[0] / 65535.0, 0.5, 1e-4);
  EXPECT_NEAR(weights_of(packed[3])[1] / 65535.0, 0.5, 1e-4);
  EXPECT_EQ(weights_of(packed[4])[0], 0u);
  EXPECT_EQ(weights_of(packed[5])[1], 65535u);
}

TEST(PackInfluences, a_primitive_without_skin_has_none) {
  Primitive primitive;
  primitive.positions = {vec3(0.0f)};
  EXPECT_TRUE(pack_influences(primitive).empty());
}

TEST(PackMorphOffsets, go_target_by_target_positions_before_normals) {
  Primitive primitive;
  primitive.positions = {vec3(0.0f), vec3(1.0f)};
  primitive.morph_targets.resize(2);
  primitive.morph_targets[0].positions = {vec3(1, 2, 3), vec3(4, 5, 6)};
  primitive.morph_targets[1].positions = {vec3(7, 8, 9), vec3(10, 11, 12)};
  bool has_normals = true;
  EXPECT_EQ(pack_morph_offsets(primitive, has_normals), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_FALSE(has_normals);

  primitive.morph_targets[0].normals = {vec3(-1, -2, -3), vec3(-4, -5, -6)};
  (void)pack_morph_offsets(primitive, has_normals);
  EXPECT_FALSE(has_normals) << "normals of some targets only do not count";

  primitive.morph_targets[1].normals = {vec3(-7, -8, -9), vec3(-10, -11, -12)};
  EXPECT_EQ(
      pack_morph_offsets(primitive, has_normals),
      (std::vector<float>{1, 2, 3, 4, 5, 6, -1, -2, -3, -4, -5, -6, 7, 8, 9, 10, 11, 12, -7, -8, -9, -10, -11, -12}));
  EXPECT_TRUE(has_normals);
}

TEST(PackMorphOffsets, no_targets_no_offsets) {
  Primitive primitive;
  primitive.positions = {vec3(0.0f)};
  bool has_normals = true;
  EXPECT_TRUE(pack_morph_offsets(primitive, has_normals).empty());
  EXPECT_FALSE(has_normals);
}

using Triangle = std::array<std::uint32_t, 3>;

/// Rotates the triangle to begin with its least corner. The winding stays.
Triangle from_least_corner(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::map<Triangle, int> counted(const std::vector<std::uint32_t>& indices) {
  std::map<Triangle, int> triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    ++triangles[from_least_corner({indices[i], indices[i + 1], indices[i + 2]})];
  return triangles;
}

TEST(BuildClusters, cover_every_triangle_once_and_bound_its_corners) {
  Random random(4);
  for (int round = 0; round < test::scaled(40); ++round) {
    Primitive primitive;
    const std::uint32_t vertices = 3 + random.below(400);
    const std::uint32_t triangles =
        round < 4 ? std::array{1u, 256u, 257u, 512u}[static_cast<std::size_t>(round)] : 1 + random.below(1500);
    for (std::uint32_t i = 0; i < vertices; ++i) primitive.positions.push_back(random.point(10.0f));
    for (std::uint32_t i = 0; i < 3 * triangles; ++i) primitive.indices.push_back(random.below(vertices));
    std::vector<std::uint32_t> indices;
    const auto clusters = build_clusters(primitive, indices);
    ASSERT_EQ(counted(indices), counted(primitive.indices));
    ASSERT_EQ(clusters.size(), (triangles + kClusterTriangles - 1) / kClusterTriangles);
    std::uint32_t next = 0;
    for (const Cluster& cluster : clusters) {
      ASSERT_EQ(cluster.first_index, next) << "clusters lie one behind the other";
      ASSERT_EQ(cluster.index_count % 3, 0u);
      ASSERT_GT(cluster.index_count, 0u);
      ASSERT_LE(cluster.index_count, 3 * kClusterTriangles);
      for (std::uint32_t i = 0; i < cluster.index_count; ++i) {
        const vec3 p = primitive.positions[indices[next + i]];
        ASSERT_TRUE(glm::all(glm::lessThanEqual(cluster.bounds.min, p)) &&
                    glm::all(glm::lessThanEqual(p, cluster.bounds.max)));
      }
      next += cluster.index_count;
    }
    ASSERT_EQ(next, primitive.indices.size());
  }
}

TEST(BuildClusters, neighbours_lie_together) {
  // A flat grid in scrambled order: clusters of 256 of its 8,192 triangles should be far smaller than the grid.
  constexpr std::uint32_t kSide = 64;
  Primitive primitive;
  std::vector<Triangle> triangles;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x) primitive.positions.push_back(vec3(x, 0.0f, y));
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t at = y * (kSide + 1) + x;
      triangles.push_back({at, at + kSide + 1, at + 1});
      triangles.push_back({at + 1, at + kSide + 1, at + kSide + 2});
    }
  }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(5));
  for (const Triangle& t : triangles) primitive.indices.insert(primitive.indices.end(), t.begin(), t.end());
  std::vector<std::uint32_t> indices;
  double area = 0.0;
  for (const Cluster& cluster : build_clusters(primitive, indices)) {
    const vec3 size = cluster.bounds.max - cluster.bounds.min;
    area += static_cast<double>(size.x) * size.z;
  }
  EXPECT_LT(area, 4.0 * kSide * kSide) << "boxes overlap much: culling clusters would gain little";
}

TEST(BuildClusters, nothing_gives_none) {
  std::vector<std::uint32_t> indices = {1, 2, 3};
  EXPECT_TRUE(build_clusters(Primitive{}, indices).empty());
  EXPECT_TRUE(indices.empty());
}

TEST(FetchOrder, keeps_every_corner_and_names_vertices_in_order) {
  Random random(9);
  Primitive primitive;
  primitive.material = 3;
  for (int i = 0; i < 500; ++i) {
    primitive.positions.push_back(random.point(10.0f));
    primitive.normals.push_back(random.direction());
    primitive.uv1.push_back(vec2(static_cast<float>(i), 0.0f));
    primitive.joints.push_back({static_cast<std::uint16_t>(i), 0, 0, 0});
    primitive.weights.push_back(vec4(1.0f, 0.0f, 0.0f, 0.0f));
  }
  primitive.morph_targets.push_back({primitive.normals, {}});
  std::vector<std::uint32_t> before(900);
  for (std::uint32_t& index : before) index = random.below(400);  // no index uses the last hundred vertices
  std::vector<std::uint32_t> after = before;
  const Primitive ordered = in_fetch_order(primitive, after);
  EXPECT_LT(ordered.positions.size(), 401u);
  EXPECT_EQ(ordered.material, 3u);
  EXPECT_TRUE(ordered.uv0.empty());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::uint32_t from = before[i], to = after[i];
    ASSERT_LE(to, next);
    if (to == next) ++next;
    ASSERT_EQ(ordered.positions[to], primitive.positions[from]);
    ASSERT_EQ(ordered.normals[to], primitive.normals[from]);
    ASSERT_EQ(ordered.uv1[to], primitive.uv1[from]);
    ASSERT_EQ(ordered.joints[to], primitive.joints[from]);
    ASSERT_EQ(ordered.weights[to], primitive.weights[from]);
    ASSERT_EQ(ordered.morph_targets[0].positions[to], primitive.morph_targets[0].positions[from]);
  }
  EXPECT_EQ(next, ordered.positions.size());
}

}  // namespace
}  // namespace gloam
