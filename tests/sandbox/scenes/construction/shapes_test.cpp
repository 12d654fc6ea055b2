// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/construction/shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace gloam {
namespace {

/// Checks counts, bounds, unit normals, and that every triangle has an area and faces the way of its normals.
void expect_sound(const Primitive& shape) {
  ASSERT_FALSE(shape.indices.empty());
  ASSERT_EQ(shape.indices.size() % 3, 0u);
  ASSERT_EQ(shape.normals.size(), shape.positions.size());
  Aabb bounds;
  for (std::size_t i = 0; i < shape.positions.size(); ++i) {
    bounds.grow(shape.positions[i]);
    EXPECT_NEAR(glm::length(shape.normals[i]), 1.0f, 1e-5f);
  }
  EXPECT_EQ(bounds.min, shape.bounds.min);
  EXPECT_EQ(bounds.max, shape.bounds.max);
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    vec3 corner[3];
    vec3 normal(0.0f);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LT(shape.indices[i + k], shape.positions.size());
      corner[k] = shape.positions[shape.indices[i + k]];
      normal += shape.normals[shape.indices[i + k]];
    }
    const vec3 face = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    EXPECT_GT(glm::length(face), 1e-9f) << "triangle " << i / 3 << " has no area";
    EXPECT_GT(glm::dot(face, normal), 0.0f) << "triangle " << i / 3 << " is turned against its normals";
  }
}

/// Volume of a closed surface; positive if its faces point outwards.
float volume_of(const Primitive& shape) {
  float volume = 0.0f;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const vec3 a = shape.positions[shape.indices[i]];
    const vec3 b = shape.positions[shape.indices[i + 1]];
    const vec3 c = shape.positions[shape.indices[i + 2]];
    volume += glm::dot(a, glm::cross(b, c)) / 6.0f;
  }
  return volume;
}

TEST(Shapes, a_box_encloses_its_volume) {
  const Primitive box = box_shape({2.0f, 3.0f, 4.0f});
  expect_sound(box);
  EXPECT_NEAR(volume_of(box), 24.0f, 1e-4f);
  EXPECT_EQ(box.bounds.min, vec3(-1.0f, 0.0f, -2.0f));
}

TEST(Shapes, a_turned_shape_encloses_its_volume) {
  const vec2 cylinder[] = {{0.0f, 0.0f}, {0.5f, 0.0f}, {0.5f, 2.0f}, {0.0f, 2.0f}};
  const Primitive shape = turned_shape(cylinder, 256);
  expect_sound(shape);
  EXPECT_NEAR(volume_of(shape), kPi * 0.25f * 2.0f, 1e-3f);
}

TEST(Shapes, a_sphere_encloses_its_volume) {
  const Primitive sphere = sphere_shape(1.5f, 128);
  expect_sound(sphere);
  EXPECT_NEAR(volume_of(sphere), 4.0f / 3.0f * kPi * 3.375f, 0.02f);
}

TEST(Shapes, an_arch_is_a_wall_less_half_a_disk) {
  const Primitive arch = arch_shape({.width_m = 3.0f, .height_m = 2.0f, .radius_m = 1.2f, .depth_m = 0.5f}, 200);
  expect_sound(arch);
  EXPECT_NEAR(volume_of(arch), (6.0f - 0.5f * kPi * 1.44f) * 0.5f, 1e-3f);
}

TEST(Shapes, a_rectangle_faces_plus_z_and_its_image_stands_upright) {
  const Primitive rectangle = rectangle_shape({2.0f, 3.0f});
  ASSERT_EQ(rectangle.positions.size(), 4u);
  ASSERT_EQ(rectangle.uv0.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rectangle.normals[i], vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(rectangle.uv0[i].x, rectangle.positions[i].x * 0.5f + 0.5f);
    EXPECT_EQ(rectangle.uv0[i].y, 1.0f - rectangle.positions[i].y / 3.0f);
  }
}

TEST(Shapes, appended_shapes_keep_their_volumes) {
  Primitive both;
  append_shape(both, box_shape({1.0f, 1.0f, 1.0f}), {0.0f, 0.0f, 0.0f});
  append_shape(both, box_shape({2.0f, 1.0f, 1.0f}), {5.0f, 2.0f, 0.0f});
  expect_sound(both);
  EXPECT_NEAR(volume_of(both), 3.0f, 1e-4f);
  EXPECT_EQ(both.bounds.min, vec3(-0.5f, 0.0f, -0.5f));
  EXPECT_EQ(both.bounds.max, vec3(6.0f, 3.0f, 0.5f));
}

}  // namespace
}  // namespace gloam
