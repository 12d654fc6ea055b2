// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "engine/render/packing/smooth_shading.h"
#include "tests/render/passes/smooth_surface_oracle.h"
#include "tests/support/render_scene.h"

// Properties of the smooth surface that tests compare pictures with, and which meshes have one.

namespace gloam {
namespace {

using test::Corner;
using test::Facet;

/// A facet of random corners. spread: how far the normals are from the face normal.
Facet random_facet(std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto vector = [&] { return dvec3(number(random), number(random), number(random)); };
  Facet facet;
  for (Corner& corner : facet) corner.position = vector();
  const dvec3 face =
      glm::normalize(glm::cross(facet[1].position - facet[0].position, facet[2].position - facet[0].position));
  for (Corner& corner : facet) corner.normal = glm::normalize(face + spread * vector());
  return facet;
}

dvec3 random_share(std::mt19937& random) {
  std::uniform_real_distribution<double> number(0.01, 1.0);
  const dvec3 share(number(random), number(random), number(random));
  return share / (share.x + share.y + share.z);
}

TEST(SmoothSurface, passes_through_the_vertices) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Facet facet = random_facet(random, 0.5);
    for (int corner = 0; corner < 3; ++corner) {
      dvec3 share(0.0);
      share[corner] = 1.0;
      EXPECT_LE(glm::length(test::hanika_offset(facet, share)), 1e-15);
    }
  }
}

TEST(SmoothSurface, is_the_facet_itself_where_all_normals_are_the_face_normal) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i)
    EXPECT_LE(glm::length(test::hanika_offset(random_facet(random, 0.0), random_share(random))), 1e-15);
}

TEST(SmoothSurface, is_on_the_side_of_the_normals_and_only_of_planes_above_the_point) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const Facet facet = random_facet(random, 0.4);
    const dvec3 share = random_share(random), offset = test::hanika_offset(facet, share);
    const dvec3 face = glm::cross(facet[1].position - facet[0].position, facet[2].position - facet[0].position);
    EXPECT_GE(glm::dot(offset, face), 0.0);
    bool above = false;
    for (const Corner& corner : facet)
      above = above || glm::dot(test::point_of(facet, share) - corner.position, corner.normal) < 0.0;
    EXPECT_EQ(glm::length(offset) > 0.0, above);
  }
}

TEST(SmoothSurface, of_a_facet_of_a_sphere_is_nearer_to_the_sphere) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-0.3, 0.3);
  for (int i = 0; i < 500; ++i) {
    Facet facet;
    for (Corner& corner : facet)
      corner.position = corner.normal = glm::normalize(dvec3(number(random), number(random), 1.0));
    ASSERT_TRUE(test::is_convex(facet));
    const dvec3 share = random_share(random), point = test::point_of(facet, share);
    const double depth = 1.0 - glm::length(point);
    EXPECT_LE(std::abs(1.0 - glm::length(point + test::hanika_offset(facet, share))), depth + 1e-15);
  }
}

TEST(SmoothShading, is_found_where_normals_are_not_those_of_the_faces) {
  const auto smooth = [](const Primitive& p) { return is_smooth_shaded(p.positions, p.normals, p.indices); };
  Primitive box = test::box(vec3(1.0f, 2.0f, 3.0f));
  EXPECT_FALSE(smooth(box));
  EXPECT_FALSE(smooth(test::quad(1.0f)));
  // Turned, so that coordinates are rounded, and far from the mesh's origin.
  const glm::mat3 turn(glm::rotate(dmat4(1.0), 0.7, glm::normalize(dvec3(1.0, 2.0, 3.0))));
  for (vec3& position : box.positions) position = turn * position + vec3(50.0f);
  for (vec3& normal : box.normals) normal = turn * normal;
  EXPECT_FALSE(smooth(box));
  box.normals.back() = glm::normalize(box.normals.back() + vec3(0.01f, 0.02f, 0.0f));
  EXPECT_TRUE(smooth(box));
  EXPECT_FALSE(is_smooth_shaded({}, {}, {}));
}

}  // namespace
}  // namespace gloam
