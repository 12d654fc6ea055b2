// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/caster_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/render_scene.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class CasterBounds : public ::testing::Test {
 protected:
  [[nodiscard]] double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] dvec3 point(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] Aabb box() {
    Aabb made;
    for (int i = 0; i < 2; ++i) made.grow(vec3(point(3.0)));
    return made;
  }
  /// A random affine matrix: sheared, and sometimes mirrored or flattened.
  [[nodiscard]] dmat4 affine(double far) {
    dmat4 m(1.0);
    for (int c = 0; c < 3; ++c) m[c] = dvec4(point(2.0), 0.0);
    if (random_() % 4 == 0) m[static_cast<int>(random_() % 3)] = dvec4(0.0);
    m[3] = dvec4(point(far), 1.0);
    return m;
  }
  [[nodiscard]] dvec3 inside(const Aabb& b) {
    dvec3 p;
    for (int c = 0; c < 3; ++c)
      p[c] =
          random_() % 2 == 0 ? in(b.min[c], b.max[c]) : static_cast<double>(random_() % 2 == 0 ? b.min[c] : b.max[c]);
    return p;
  }

  std::mt19937 random_{21};
};

bool contains(const WorldBox& box, const dvec3& p, double slack) {
  return glm::all(glm::greaterThanEqual(p, box.min - slack)) && glm::all(glm::lessThanEqual(p, box.max + slack));
}

TEST_F(CasterBounds, a_moved_box_holds_its_points_and_touches_its_corners_far_away_too) {
  for (int round = 0; round < test::scaled(2000); ++round) {
    const Aabb rest = box();
    const dmat4 m = affine(round % 2 == 0 ? 5.0 : 1e5);
    const WorldBox moved = world_box(rest, m);
    ASSERT_TRUE(moved.known());
    WorldBox corners;
    for (int c = 0; c < 8; ++c) {
      const dvec3 corner(c & 1 ? rest.max.x : rest.min.x, c & 2 ? rest.max.y : rest.min.y,
                         c & 4 ? rest.max.z : rest.min.z);
      const dvec3 at(m * dvec4(corner, 1.0));
      corners.min = glm::min(corners.min, at);
      corners.max = glm::max(corners.max, at);
    }
    ASSERT_LT(glm::length(moved.min - corners.min) + glm::length(moved.max - corners.max), 1e-9);
    ASSERT_TRUE(contains(moved, dvec3(m * dvec4(inside(rest), 1.0)), 1e-9));
  }
}

TEST_F(CasterBounds, boxes_that_are_empty_or_not_finite_are_not_known) {
  EXPECT_FALSE(WorldBox{}.known());
  EXPECT_FALSE(world_box(Aabb{}, dmat4(1.0)).known());
  const Aabb unit{vec3(0.0f), vec3(1.0f)};
  EXPECT_TRUE(world_box(unit, dmat4(1.0)).known());
  EXPECT_TRUE(world_box(unit, dmat4(dvec4(0.0), dvec4(0.0), dvec4(0.0), dvec4(1.0))).known()) << "a point is a box";
  for (const double bad : {std::nan(""), static_cast<double>(kInfinity)}) {
    dmat4 m(1.0);
    m[1][0] = bad;
    EXPECT_FALSE(world_box(unit, m).known());
  }
}

TEST_F(CasterBounds, morphing_stays_in_reach_whatever_the_weights) {
  for (int round = 0; round < test::scaled(300); ++round) {
    Primitive p = test::quad(1.0f);
    std::vector<float> weights;
    GpuPrimitive gpu;
    for (int t = 0; t < 3; ++t) {
      Primitive::MorphTarget target;
      Aabb& bounds = gpu.morph_bounds.emplace_back();
      for (int v = 0; v < 4; ++v) bounds.grow(target.positions.emplace_back(vec3(point(2.0))));
      p.morph_targets.push_back(target);
      weights.push_back(static_cast<float>(in(-1.5, 1.5)));
    }
    const Aabb reach = morph_reach(gpu, weights);
    for (std::size_t v = 0; v < 4; ++v) {
      dvec3 offset(0.0);
      for (std::size_t t = 0; t < 3; ++t)
        offset += static_cast<double>(weights[t]) * dvec3(p.morph_targets[t].positions[v]);
      ASSERT_TRUE(contains(WorldBox{dvec3(reach.min), dvec3(reach.max)}, offset, 1e-5));
    }
  }
}

TEST_F(CasterBounds, a_posed_box_holds_every_mix_of_its_joints) {
  int mixes = 0;
  const int rounds = test::scaled(500);
  for (int round = 0; round < rounds; ++round) {
    JointMatrices joints;
    const JointMatrices::Range range{Entity{}, 2, 3, point(round % 2 == 0 ? 5.0 : 1e5), false};
    joints.matrices.assign(2, mat4(0.0f));
    GpuPrimitive primitive;
    for (std::uint32_t j = 0; j < 3; ++j) {
      joints.matrices.push_back(mat4(affine(3.0)));
      primitive.joint_bounds.emplace_back(j, box());
    }
    Aabb reach;
    if (round % 3 == 0) reach = box();
    const WorldBox posed = posed_box(primitive, joints, range, reach);
    ASSERT_TRUE(posed.known());
    // A vertex lies in the boxes of all joints that it follows.
    const auto a = static_cast<std::uint32_t>(random_() % 3), b = static_cast<std::uint32_t>(random_() % 3);
    const Aabb &one = primitive.joint_bounds[a].second, &other = primitive.joint_bounds[b].second;
    const Aabb both{glm::max(one.min, other.min), glm::min(one.max, other.max)};
    if (both.empty()) continue;
    ++mixes;
    const dvec4 at(inside(both) + (reach.empty() ? dvec3(0.0) : inside(reach)), 1.0);
    const double share = in(0.0, 1.0);
    const dvec4 mixed =
        share * (dmat4(joints.matrices[2 + a]) * at) + (1.0 - share) * (dmat4(joints.matrices[2 + b]) * at);
    ASSERT_TRUE(contains(posed, dvec3(mixed) + range.origin, 1e-5));
  }
  EXPECT_GT(mixes, rounds / 5);
}

TEST_F(CasterBounds, joints_that_are_missing_or_not_finite_leave_bounds_unknown) {
  JointMatrices joints;
  joints.matrices.assign(2, mat4(1.0f));
  JointMatrices::Range range{Entity{}, 0, 2, dvec3(0.0), false};
  GpuPrimitive primitive;
  primitive.joint_bounds = {{0, {vec3(0.0f), vec3(1.0f)}}, {1, {vec3(0.0f), vec3(1.0f)}}};
  EXPECT_TRUE(posed_box(primitive, joints, range, {}).known());
  range.count = 1;
  EXPECT_FALSE(posed_box(primitive, joints, range, {}).known());
  range.count = 2;
  joints.matrices[1][3].x = kInfinity;
  EXPECT_FALSE(posed_box(primitive, joints, range, {}).known());
  EXPECT_FALSE(posed_box(GpuPrimitive{}, joints, range, {}).known()) << "no vertex at all";
}

}  // namespace
}  // namespace gloam
