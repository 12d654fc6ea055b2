// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/skinning.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <random>
#include <vector>

#include "tests/scene/forest.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

dmat4 translation(const dvec3& by) { return glm::translate(dmat4(1.0), by); }

TEST(Skinning, matrices_equal_the_product_relative_to_the_first_joint) {
  std::mt19937 random(11);
  std::vector<dmat4> worlds;
  std::vector<mat4> inverse_bind;
  for (int i = 0; i < 20; ++i) {
    worlds.push_back(local_matrix(test::random_pose(random)));
    inverse_bind.push_back(mat4(glm::inverse(local_matrix(test::random_pose(random)))));
  }
  std::vector<mat4> matrices(worlds.size());
  const SkinPlacement placement = place_joints(worlds, inverse_bind, dmat4(1.0), matrices);
  EXPECT_EQ(placement.origin, dvec3(worlds[0][3]));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const dmat4 expected = translation(-placement.origin) * worlds[i] * dmat4(inverse_bind[i]);
    EXPECT_LT(test::relative_difference(dmat4(matrices[i]), expected), 2e-7);
  }
}

TEST(Skinning, ten_kilometres_from_the_origin_lose_no_precision) {
  // The same skin near the origin and 10 km away: the relative matrices differ only by the rounding of doubles at 10
  // km.
  std::mt19937 random(3);
  std::vector<dmat4> near_worlds;
  for (int i = 0; i < 8; ++i) near_worlds.push_back(local_matrix(test::random_pose(random)));
  const std::vector<mat4> inverse_bind(near_worlds.size(), mat4(1.0f));
  std::vector<dmat4> far_worlds;
  for (const dmat4& world : near_worlds) far_worlds.push_back(translation(dvec3(10'000.0, 200.0, -10'000.0)) * world);
  std::vector<mat4> near_matrices(near_worlds.size());
  std::vector<mat4> far_matrices(near_worlds.size());
  place_joints(near_worlds, inverse_bind, dmat4(1.0), near_matrices);
  place_joints(far_worlds, inverse_bind, dmat4(1.0), far_matrices);
  for (std::size_t i = 0; i < near_worlds.size(); ++i)
    EXPECT_LT(test::relative_difference(dmat4(far_matrices[i]), dmat4(near_matrices[i])), 2e-7);
}

TEST(Skinning, a_mirroring_first_joint_mirrors_the_surface) {
  const dmat4 mirror = glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0));
  const std::vector<mat4> identity{mat4(1.0f)};
  std::vector<mat4> out(1);
  EXPECT_FALSE(place_joints(std::vector{dmat4(1.0)}, identity, mirror, out).mirrored);
  EXPECT_TRUE(place_joints(std::vector{mirror}, identity, dmat4(1.0), out).mirrored);
  // A mirror in the bind pose and in the joint undo each other.
  EXPECT_FALSE(place_joints(std::vector{mirror}, std::vector{mat4(mirror)}, dmat4(1.0), out).mirrored);
}

TEST(Skinning, the_mesh_nodes_own_transform_does_not_count) {
  const std::vector<dmat4> worlds{translation(dvec3(1.0, 2.0, 3.0))};
  const std::vector<mat4> inverse_bind{mat4(1.0f)};
  std::vector<mat4> a(1);
  std::vector<mat4> b(1);
  const SkinPlacement first = place_joints(worlds, inverse_bind, dmat4(1.0), a);
  const SkinPlacement second = place_joints(worlds, inverse_bind, translation(dvec3(50.0)), b);
  EXPECT_EQ(a, b);
  EXPECT_EQ(first.origin, second.origin);
}

TEST(Skinning, a_skin_without_joints_is_placed_at_its_instance) {
  const SkinPlacement placement = place_joints({}, {}, translation(dvec3(4.0, 5.0, 6.0)), {});
  EXPECT_EQ(placement.origin, dvec3(4.0, 5.0, 6.0));
  EXPECT_FALSE(placement.mirrored);
}

TEST(Skinning, sizes_that_differ_assert) {
  std::vector<mat4> out(1);
  EXPECT_ASSERT((void)place_joints(std::vector{dmat4(1.0)}, {}, dmat4(1.0), out), "inverse bind");
}

}  // namespace
}  // namespace gloam
