// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <random>

namespace gloam {
namespace {

constexpr float kRim = 0.125f;
const mat3 kCube(GLOAM_CUBE_X, GLOAM_CUBE_Y, GLOAM_CUBE_Z);
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Light spot(float full_cone_degrees) {
  Light light;
  light.kind = LightKind::spot;
  light.outer_angle = full_cone_degrees * kPi / 360.0f;
  light.range_m = 10.0f;
  return light;
}

Light point() {
  Light light;
  light.range_m = 10.0f;
  return light;
}

ShadowFace face_of(const Light& light, const dmat4& node, std::uint32_t index = 0, std::uint32_t size = 256) {
  ShadowFace face = local_face(Entity{1, 1}, local_shadow(light, node, kRim), index);
  face.square = {uvec2(0), size};
  return face;
}

void expect_unit_axes(const FaceAxes& axes) {
  for (const vec3& v : {axes.right, axes.up, axes.forward}) EXPECT_NEAR(glm::length(v), 1.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(axes.right, axes.up), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(axes.right, axes.forward), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::dot(axes.up, axes.forward), 0.0f, 1e-6f);
}

void expect_near(const vec3& a, const vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(ShadowFaces, node_axes_follow_the_node_with_its_roll) {
  const dmat4 rolled = glm::rotate(glm::rotate(dmat4(1.0), 0.7, dvec3(0.3, 1.0, 0.2)), 1.1, dvec3(0.0, 0.0, 1.0));
  const FaceAxes axes = node_axes(glm::scale(glm::translate(dmat4(1.0), dvec3(5.0)) * rolled, dvec3(3.0, 0.01, 200.0)));
  expect_near(axes.right, vec3(rolled[0]));
  expect_near(axes.up, vec3(rolled[1]));
  expect_near(axes.forward, -vec3(rolled[2]));
}

TEST(ShadowFaces, node_axes_of_mirrored_nodes_are_mirrored) {
  const dmat4 turned = glm::rotate(dmat4(1.0), 0.7, dvec3(0.3, 1.0, 0.2));
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 scale(1.0);
    scale[axis] = -2.0;
    const dmat4 node = glm::scale(turned, scale);
    const FaceAxes axes = node_axes(node);
    expect_unit_axes(axes);
    expect_near(axes.right, vec3(glm::normalize(dvec3(node[0]))));
    expect_near(axes.up, vec3(glm::normalize(dvec3(node[1]))));
    expect_near(axes.forward, -vec3(glm::normalize(dvec3(node[2]))));
    EXPECT_LT(glm::dot(glm::cross(axes.right, axes.up), -axes.forward), 0.0f);
  }
}

TEST(ShadowFaces, node_axes_of_sheared_nodes_stand_at_right_angles_and_look_along_minus_z) {
  dmat4 node(1.0);
  node[2] = dvec4(0.9, 0.4, 1.0, 0.0);
  node[1] = dvec4(0.8, 1.0, -0.3, 0.0);
  const FaceAxes axes = node_axes(node);
  expect_unit_axes(axes);
  expect_near(axes.forward, -vec3(glm::normalize(dvec3(node[2]))));
  EXPECT_GT(glm::dot(axes.right, vec3(node[0])), 0.0f);
  EXPECT_GT(glm::dot(axes.up, vec3(node[1])), 0.0f);
}

TEST(ShadowFaces, node_axes_are_sound_whatever_the_node_is) {
  std::vector<dmat4> nodes{dmat4(0.0), dmat4(1e-300), dmat4(1e200), dmat4(kNaN), dmat4(kInfinity)};
  for (int column = 0; column < 3; ++column) {
    for (const double value : {0.0, kNaN, kInfinity, 1e308, 1e-308}) {
      dmat4 node(1.0);
      node[column] = dvec4(value, value, value, 0.0);
      nodes.push_back(node);
      node[(column + 1) % 3] = node[column];
      nodes.push_back(node);
    }
  }
  for (const dmat4& node : nodes) expect_unit_axes(node_axes(node));
  expect_near(node_axes(dmat4(0.0)).forward, vec3(0.0f, 0.0f, -1.0f));
}

TEST(ShadowFaces, cube_faces_are_the_table_of_the_shared_header) {
  struct Row {
    vec3 forward, up, right;
  };
  const Row table[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                        {{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}},
                        {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  for (std::uint32_t f = 0; f < 6; ++f) {
    const FaceAxes axes = cube_axes(f);
    expect_near(axes.forward * kCube, table[f].forward);
    expect_near(axes.up * kCube, table[f].up);
    expect_near(axes.right * kCube, table[f].right);
    expect_near(axes.right, glm::cross(axes.forward, axes.up));
  }
}

TEST(ShadowFaces, a_cube_is_turned_so_that_no_axis_of_the_world_runs_along_texels) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(glm::dot(dvec3(kCube[i]), dvec3(kCube[j])), i == j ? 1.0 : 0.0, 2e-7);
  EXPECT_GT(glm::determinant(kCube), 0.0f);
  for (std::uint32_t f = 0; f < 6; ++f) {
    const FaceAxes axes = cube_axes(f);
    for (int world = 0; world < 3; ++world) {
      const glm::dvec2 seen(axes.right[world], axes.up[world]);
      if (glm::length(seen) < 0.5) continue;  // strongly foreshortened
      EXPECT_GT(std::min(std::abs(seen.x), std::abs(seen.y)) / glm::length(seen), std::sin(glm::radians(8.0)));
    }
  }
}

TEST(ShadowFaces, every_direction_lies_inside_the_face_it_belongs_to_and_in_no_other) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const dvec3 at(3.0, -2.0, 7.0);
  for (int i = 0; i < 2000; ++i) {
    const dvec3 direction(unit(random), unit(random), unit(random));
    const std::uint32_t own = cube_face_of(direction);
    for (std::uint32_t f = 0; f < 6; ++f) {
      const ShadowFace face = face_of(point(), glm::translate(dmat4(1.0), at), f);
      const auto seen = project(face, at + direction);
      const double inner = 0.5 * 256.0 / (1.0 + kRim) * (1.0 + 1e-9);
      const bool inside = seen && std::abs(seen->x - 128.0) <= inner && std::abs(seen->y - 128.0) <= inner;
      EXPECT_EQ(inside, f == own);
    }
  }
}

TEST(ShadowFaces, directions_on_seams_belong_to_one_face_and_lie_on_its_border) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const dvec3 direction = kCube * vec3(x, y, z);
        if (direction == dvec3(0.0)) continue;
        const std::uint32_t own = cube_face_of(direction);
        EXPECT_TRUE((own / 2 == 0 && x != 0) || (own / 2 == 1 && y != 0) || (own / 2 == 2 && z != 0));
        const auto seen = project(face_of(point(), dmat4(1.0), own), direction);
        ASSERT_TRUE(seen.has_value());
        const double inner = 128.0 / (1.0 + kRim);
        EXPECT_LE(std::abs(seen->x - 128.0), inner * (1.0 + 1e-6));
        EXPECT_LE(std::abs(seen->y - 128.0), inner * (1.0 + 1e-6));
      }
}

TEST(ShadowFaces, texels_run_right_and_down_and_depth_is_reversed) {
  const ShadowFace face = face_of(spot(90.0f), dmat4(1.0));
  const auto center = project(face, dvec3(0.0, 0.0, -2.0));
  ASSERT_TRUE(center.has_value());
  EXPECT_NEAR(center->x, 128.0, 1e-9);
  EXPECT_NEAR(center->y, 128.0, 1e-9);
  EXPECT_NEAR(center->depth, face.near_m / 2.0, 1e-9 * face.near_m);
  EXPECT_NEAR(center->along_m, 2.0, 1e-9);
  EXPECT_GT(project(face, dvec3(1.0, 0.0, -2.0))->x, 128.0);
  EXPECT_LT(project(face, dvec3(0.0, 1.0, -2.0))->y, 128.0);
  // The cone's edge is where the rim begins.
  EXPECT_NEAR(project(face, dvec3(2.0, 0.0, -2.0))->x, 128.0 + 128.0 / 1.125, 1e-4);
  EXPECT_FALSE(project(face, dvec3(0.0, 0.0, 0.0)).has_value());
  EXPECT_FALSE(project(face, dvec3(0.0, 0.0, 1.0)).has_value());
}

TEST(ShadowFaces, what_is_unprojected_projects_back_far_from_the_origin_too) {
  const dmat4 node = glm::rotate(glm::translate(dmat4(1.0), dvec3(1e5, -1e5, 1e5)), 0.8, dvec3(1.0, 2.0, 3.0));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> texel(0.0, 256.0);
  for (const Light& light : {spot(50.0f), spot(170.0f), point()}) {
    for (std::uint32_t f = 0; f < local_shadow(light, node, kRim).face_count(); ++f) {
      const ShadowFace face = face_of(light, node, f);
      for (int i = 0; i < 20; ++i) {
        const double x = texel(random);
        const double y = texel(random);
        const auto seen = project(face, unproject(face, x, y, 4.0));
        ASSERT_TRUE(seen.has_value());
        EXPECT_NEAR(seen->x, x, 1e-3);
        EXPECT_NEAR(seen->y, y, 1e-3);
        EXPECT_NEAR(seen->along_m, 4.0, 1e-5);
      }
    }
  }
}

// Hard case: shadows.cone_120
TEST(ShadowFaces, cones_up_to_120_degrees_have_one_face_and_wider_ones_a_cube) {
  for (const float cone : {-5.0f, 0.0f, 1.0f, 45.0f, 119.0f, 120.0f}) {
    const LocalShadow shadow = local_shadow(spot(cone), dmat4(1.0), kRim);
    EXPECT_EQ(shadow.kind, static_cast<std::uint32_t>(GLOAM_SHADOW_SPOT)) << cone;
    EXPECT_EQ(shadow.face_count(), 1u);
    const float half = std::max(cone * 0.5f, 1.0f) * kPi / 180.0f;
    EXPECT_NEAR(shadow.tan_inner, std::tan(half), 1e-5f) << cone;
    EXPECT_FLOAT_EQ(shadow.tan_half, shadow.tan_inner * 1.125f);
    EXPECT_FLOAT_EQ(shadow.cookie_tan, shadow.tan_inner);
  }
  for (const float cone : {121.0f, 179.0f, 180.0f, 181.0f, 360.0f}) {
    const LocalShadow shadow = local_shadow(spot(cone), dmat4(1.0), kRim);
    EXPECT_EQ(shadow.kind, static_cast<std::uint32_t>(GLOAM_SHADOW_CUBE)) << cone;
    EXPECT_EQ(shadow.face_count(), 6u);
    EXPECT_EQ(shadow.tan_inner, 1.0f);
    EXPECT_TRUE(std::isfinite(shadow.cookie_tan) && shadow.cookie_tan > 1.0f);
  }
}

TEST(ShadowFaces, the_whole_cone_lies_inside_the_faces_without_their_rims) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const float cone : {2.0f, 60.0f, 120.0f}) {
    const dmat4 node = glm::rotate(dmat4(1.0), 2.0, dvec3(1.0, -1.0, 0.4));
    const ShadowFace face = face_of(spot(cone), node);
    for (int i = 0; i < 200; ++i) {
      const double angle = unit(random) * cone * kPi / 360.0;
      const double round = unit(random) * 6.28318;
      const dvec3 direction(std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round), -std::cos(angle));
      const auto seen = project(face, dvec3(node * dvec4(direction * 3.0, 1.0)));
      ASSERT_TRUE(seen.has_value());
      EXPECT_LE(std::max(std::abs(seen->x - 128.0), std::abs(seen->y - 128.0)), 128.0 / 1.125 * (1.0 + 1e-5));
    }
  }
}

TEST(ShadowFaces, numbers_that_are_none_make_no_face) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_EQ(local_shadow(point(), glm::translate(dmat4(1.0), dvec3(0.0, bad, 0.0)), kRim).face_count(), 0u);
    Light light = spot(40.0f);
    light.outer_angle = static_cast<float>(bad);
    EXPECT_EQ(local_shadow(light, dmat4(1.0), kRim).face_count(), 0u);
    light = spot(40.0f);
    light.width_m = static_cast<float>(bad);
    EXPECT_EQ(local_shadow(light, dmat4(1.0), kRim).emitter_diameter_m, 0.0f);
    light.range_m = light.intensity = static_cast<float>(bad);
    const LocalShadow shadow = local_shadow(light, dmat4(1.0), kRim);
    EXPECT_TRUE(std::isfinite(shadow.range_m));
  }
}

TEST(ShadowFaces, the_near_plane_is_a_share_of_the_range) {
  for (const float range : {1e-3f, 0.05f, 10.0f, 1e6f}) {
    Light light = point();
    light.range_m = range;
    const LocalShadow shadow = local_shadow(light, dmat4(1.0), kRim);
    EXPECT_EQ(shadow.face_count(), 6u);
    const ShadowFace face = local_face(Entity{1, 1}, shadow, 0),
                     face16 = local_face(Entity{1, 1}, local_shadow(light, dmat4(1.0), kRim, true), 0);
    EXPECT_FLOAT_EQ(face.clip_m() / range, kNearShare);
    EXPECT_EQ(face.near_m, face.clip_m());
    EXPECT_FLOAT_EQ(face16.clip_m(), face.clip_m());
    EXPECT_FLOAT_EQ(face16.near_m / range, kNearShare16);
  }
}

TEST(ShadowFaces, directional_lights_have_none) {
  Light light = point();
  light.kind = LightKind::directional;
  EXPECT_EQ(local_shadow(light, dmat4(1.0), kRim).face_count(), 0u);
}

TEST(ShadowFaces, rows_carry_the_faces) {
  Light light = spot(40.0f);
  light.width_m = 0.2f;
  const LocalShadow shadow = local_shadow(light, dmat4(1.0), kRim);
  const AtlasSquare square{uvec2(512, 256), 128};
  const shaders::ShadowRow row = shadow_row(shadow, std::span(&square, 1));
  EXPECT_EQ(row.kind, static_cast<float>(GLOAM_SHADOW_SPOT));
  EXPECT_EQ(row.near_m, shadow.near_m);
  EXPECT_EQ(row.emitter_diameter_m, 0.2f);
  EXPECT_EQ(row.size, 128.0f);
  EXPECT_EQ(row.origins[0], vec2(512.0f, 256.0f));
  EXPECT_EQ(row.tan_half, shadow.tan_half);
  EXPECT_EQ(row.tan_inner, shadow.tan_inner);
  EXPECT_EQ(row.cookie_layer, -1.0f);
  EXPECT_EQ(row.traced_layer, -1.0f);

  const shaders::ShadowRow none = shadow_row(shadow, {});
  EXPECT_EQ(none.kind, static_cast<float>(GLOAM_SHADOW_NONE));
  EXPECT_EQ(none.right, shadow.axes.right) << "cookies need them all the same";

  std::vector<AtlasSquare> squares;
  for (std::uint32_t i = 0; i < 6; ++i) squares.push_back({uvec2(i * 64, 0), 64});
  const shaders::ShadowRow cube = shadow_row(local_shadow(point(), dmat4(1.0), kRim), squares);
  EXPECT_EQ(cube.kind, static_cast<float>(GLOAM_SHADOW_CUBE));
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(cube.origins[i].x, static_cast<float>(i * 64));
}

TEST(ShadowFaces, rows_tell_shaders_where_a_spot_looks) {
  for (const dvec3& scale :
       {dvec3(1, 1, 1), dvec3(-1, 1, 1), dvec3(1, -2, 1), dvec3(1, 1, -3), dvec3(-1, -1, 1), dvec3(-1)}) {
    const dmat4 node = glm::scale(glm::rotate(dmat4(1.0), 0.7, dvec3(0.3, 1.0, 0.2)), scale);
    const shaders::ShadowRow row = shadow_row(local_shadow(spot(40.0f), node, kRim), {});
    expect_near(glm::cross(row.up, row.right) * (1.0f - 2.0f * row.mirrored), -vec3(glm::normalize(dvec3(node[2]))));
  }
}

TEST(ShadowFaces, faces_see_every_box_with_a_point_in_view) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int outside = 0;
  for (int i = 0; i < 5000; ++i) {
    const dmat4 node =
        glm::rotate(glm::translate(dmat4(1.0), dvec3(1e5)), unit(random) * 3.0, dvec3(1.0, unit(random), 2.0));
    const Light light = i % 2 == 0 ? spot(static_cast<float>(60.0 + 50.0 * unit(random))) : point();
    const ShadowFace face = face_of(light, node, i % 2 == 0 ? 0 : static_cast<std::uint32_t>(i) % 6);
    const dvec3 center = face.origin + dvec3(unit(random), unit(random), unit(random)) * 14.0;
    const dvec3 half = glm::abs(dvec3(unit(random), unit(random), unit(random))) * 3.0;
    bool any = false;
    for (int p = 0; p < 40; ++p) {
      const dvec3 at = center + half * dvec3(unit(random), unit(random), unit(random));
      const auto seen = project(face, at);
      any = any || (seen && seen->x >= 0.0 && seen->x <= 256.0 && seen->y >= 0.0 && seen->y <= 256.0 &&
                    seen->depth <= 1.0 && glm::length(at - face.origin) <= face.far_m);
    }
    const bool may = face_may_see(face, center - half, center + half);
    EXPECT_TRUE(may || !any);
    outside += may ? 0 : 1;
  }
  EXPECT_GT(outside, 2000);
}

TEST(ShadowFaces, faces_do_not_see_what_is_behind_beside_or_out_of_range) {
  const ShadowFace face = face_of(spot(90.0f), dmat4(1.0));
  const auto sees = [&](dvec3 center, double half) {
    return face_may_see(face, center - dvec3(half), center + dvec3(half));
  };
  EXPECT_TRUE(sees({0, 0, -5}, 0.1));
  EXPECT_FALSE(sees({0, 0, 5}, 1.0));
  EXPECT_FALSE(sees({9, 0, -5}, 1.0));
  EXPECT_FALSE(sees({0, -9, -5}, 1.0));
  EXPECT_TRUE(sees({0, 0, -0.02}, 0.01)) << "close before the light";
  EXPECT_FALSE(sees({0, 0, -11.2}, 1.0));
  EXPECT_TRUE(sees({0, 0, 0}, 100.0));
}

TEST(ShadowFaces, boxes_that_are_not_known_may_be_anywhere) {
  const ShadowFace face = face_of(spot(10.0f), dmat4(1.0));
  EXPECT_TRUE(face_may_see(face, dvec3(1.0), dvec3(-1.0)));
  EXPECT_TRUE(face_may_see(face, dvec3(kInfinity), dvec3(-kInfinity)));
  EXPECT_TRUE(face_may_see(face, dvec3(kNaN), dvec3(kNaN)));
  EXPECT_TRUE(face_may_see(face, dvec3(-kInfinity), dvec3(kInfinity)));
}

}  // namespace
}  // namespace gloam
