// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/face_casters.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "engine/scene/assets.h"

namespace gloam {
namespace {

ShadowFace perspective_face(const dvec3& origin) {
  ShadowFace face;
  face.origin = origin;
  face.right = vec3(0.0f, 0.0f, -1.0f);
  face.up = vec3(0.0f, 1.0f, 0.0f);
  face.forward = vec3(1.0f, 0.0f, 0.0f);
  face.tan_half = 1.125f;
  face.near_m = 0.05f;
  face.far_m = 10.0f;
  face.square = {uvec2(0), 256};
  return face;
}

ShadowFace orthographic_face(const dvec3& origin) {
  ShadowFace face = perspective_face(origin);
  face.tan_half = 0.0f;
  face.half_extent_m = 4.0f;
  face.near_m = 0.0f;
  face.far_m = 20.0f;
  return face;
}

Caster caster_of(const GpuPrimitive& primitive, const dvec3& low, const dvec3& high) {
  Caster caster;
  caster.primitive = &primitive;
  caster.bounds_min = low;
  caster.bounds_max = high;
  return caster;
}

TEST(FaceCasters, a_perspective_face_maps_points_as_documented) {
  for (const dvec3& origin : {dvec3(0.0), dvec3(1e7, -3e6, 5e6)}) {
    const ShadowFace face = perspective_face(origin);
    const dmat4 world = glm::translate(dmat4(1.0), origin + dvec3(4.0, 0.5, -1.0));
    const vec4 clip = clip_from_mesh(face, world) * vec4(0.0f, 0.25f, 0.0f, 1.0f);
    EXPECT_NEAR(clip.w, 4.0f, 1e-6f);                       // distance along the axis
    EXPECT_NEAR(clip.x / clip.w, 0.25f / 1.125f, 1e-6f);    // 1 m along right
    EXPECT_NEAR(clip.y / clip.w, 0.1875f / 1.125f, 1e-6f);  // 0.75 m along up
    EXPECT_NEAR(clip.z / clip.w, 0.05f / 4.0f, 1e-7f);
  }
}

TEST(FaceCasters, an_orthographic_face_has_depth_1_at_its_near_side_and_0_at_its_far_side) {
  const ShadowFace face = orthographic_face(dvec3(1e6, 0.0, 0.0));
  const mat4 matrix = clip_from_mesh(face, glm::translate(dmat4(1.0), face.origin));
  EXPECT_NEAR((matrix * vec4(0.0f, 0.0f, 0.0f, 1.0f)).z, 1.0f, 1e-6f);
  EXPECT_NEAR((matrix * vec4(20.0f, 0.0f, 0.0f, 1.0f)).z, 0.0f, 1e-6f);
  const vec4 clip = matrix * vec4(5.0f, 2.0f, -4.0f, 1.0f);
  EXPECT_NEAR(clip.x, 1.0f, 1e-6f);
  EXPECT_NEAR(clip.y, 0.5f, 1e-6f);
  EXPECT_EQ(clip.w, 1.0f);
}

TEST(FaceCasters, what_lies_in_the_map_is_seen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-12.0, 12.0);
  const GpuPrimitive primitive;
  int inside = 0, refused = 0;
  for (const ShadowFace& face :
       {perspective_face(dvec3(100.0, 0.0, 50.0)), orthographic_face(dvec3(100.0, 0.0, 50.0))}) {
    const FaceVolume volume = face_volume(face);
    for (int i = 0; i < 20000; ++i) {
      const dvec3 point = face.origin + dvec3(spread(random), spread(random), spread(random));
      const Caster caster = caster_of(primitive, point - dvec3(0.01), point + dvec3(0.01));
      const vec4 clip = clip_from_mesh(face, glm::translate(dmat4(1.0), point)) * vec4(0.0f, 0.0f, 0.0f, 1.0f);
      const bool mapped = clip.w > 0.0f && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z >= 0.0f;
      const bool reached = face.tan_half == 0.0f || (clip.z <= clip.w && glm::distance(point, face.origin) <= 10.0);
      if (mapped && reached) {
        ++inside;
        EXPECT_TRUE(may_see(volume, caster));
      } else {
        refused += may_see(volume, caster) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(refused, 20000);
}

TEST(FaceCasters, a_caster_without_known_bounds_is_seen) {
  const GpuPrimitive primitive;
  EXPECT_TRUE(may_see(face_volume(perspective_face(dvec3(0.0))), caster_of(primitive, dvec3(1.0), dvec3(-1.0))));
}

TEST(FaceCasters, draws_are_runs_of_clusters_that_may_be_seen_and_cut_outs_come_last) {
  GpuPrimitive primitive;
  primitive.first_index = 100;
  primitive.index_count = 40;
  for (std::uint32_t i = 0; i < 4; ++i) {
    Cluster cluster;
    cluster.first_index = 10 * i;
    cluster.index_count = 10;
    const float x = i == 2 ? -5.0f : 5.0f;  // the third is behind the face
    cluster.bounds.grow(vec3(x, 0.0f, 0.0f));
    cluster.bounds.grow(vec3(x, 0.1f, 0.1f));
    primitive.clusters.push_back(cluster);
  }
  std::vector<Caster> casters(2, caster_of(primitive, dvec3(-5.0, 0.0, 0.0), dvec3(5.0, 0.1, 0.1)));
  casters[0].variant.features = GLOAM_SURFACE_MASK;
  const auto draws = face_draws(perspective_face(dvec3(0.0)), face_volume(perspective_face(dvec3(0.0))), casters);
  ASSERT_EQ(draws.size(), 4u);
  EXPECT_EQ(draws[0].caster, &casters[1]);
  EXPECT_EQ(draws[0].first_index, 100u);
  EXPECT_EQ(draws[0].index_count, 20u);
  EXPECT_EQ(draws[1].first_index, 130u);
  EXPECT_EQ(draws[1].index_count, 10u);
  EXPECT_EQ(draws[2].caster, &casters[0]);
}

TEST(FaceCasters, fronts_alone_are_drawn_only_of_closed_casters_beyond_the_near_plane) {
  GpuPrimitive open, closed;
  open.index_count = closed.index_count = 12;
  closed.closed = true;
  const ShadowFace lamp = perspective_face(dvec3(0.0)), sun = orthographic_face(dvec3(0.0));
  const auto fronts = [](const ShadowFace& face, const Caster& caster) {
    const auto draws = face_draws(face, face_volume(face), std::span(&caster, 1));
    EXPECT_EQ(draws.size(), 1u);
    return !draws.empty() && draws.front().fronts_only;
  };
  const dvec3 low(2.0, -0.5, -0.5), high(3.0, 0.5, 0.5);
  EXPECT_TRUE(fronts(lamp, caster_of(closed, low, high)));
  EXPECT_FALSE(fronts(lamp, caster_of(open, low, high)));
  EXPECT_FALSE(fronts(lamp, caster_of(closed, dvec3(-1.0), dvec3(1.0)))) << "the lamp is inside";
  EXPECT_FALSE(fronts(lamp, caster_of(closed, dvec3(0.06, -0.5, -0.5), high)))
      << "the near plane may cut it in a corner";
  EXPECT_TRUE(fronts(lamp, caster_of(closed, dvec3(0.11, -0.5, -0.5), high)));
  EXPECT_TRUE(fronts(sun, caster_of(closed, dvec3(-1.0), dvec3(1.0)))) << "a sun has no near plane";
  EXPECT_FALSE(fronts(lamp, caster_of(closed, dvec3(1.0), dvec3(0.0)))) << "it may be anywhere";
  Caster mirrored = caster_of(closed, low, high);
  mirrored.world_from_mesh[0][0] = -1.0;
  EXPECT_FALSE(fronts(lamp, mirrored));
  mirrored.world_from_mesh[1][1] = -1.0;
  EXPECT_TRUE(fronts(lamp, mirrored)) << "mirrored twice";
  Caster cut_out = caster_of(closed, low, high);
  cut_out.variant.features = GLOAM_SURFACE_MASK;
  EXPECT_FALSE(fronts(lamp, cut_out));
}

}  // namespace
}  // namespace gloam
