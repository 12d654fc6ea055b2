// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "engine/scene/assets/vertices.h"

namespace gloam::gltf {
namespace {

/// Two triangles of the unit square in the XY plane, facing +Z; v points down the picture, as in glTF.
Primitive square() {
  Primitive primitive;
  primitive.positions = {vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)};
  primitive.normals.assign(4, vec3(0, 0, 1));
  primitive.uv0 = {vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(0, 0)};
  primitive.indices = {0, 1, 2, 0, 2, 3};
  return primitive;
}

void expect_orthonormal(const Primitive& primitive) {
  ASSERT_EQ(primitive.tangents.size(), primitive.positions.size());
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    EXPECT_NEAR(glm::length(vec3(primitive.tangents[i])), 1.0f, 1e-5f) << i;
    EXPECT_NEAR(glm::dot(vec3(primitive.tangents[i]), primitive.normals[i]), 0.0f, 1e-5f) << i;
    EXPECT_TRUE(primitive.tangents[i].w == 1.0f || primitive.tangents[i].w == -1.0f) << i;
  }
}

TEST(Tangents, point_where_u_grows_and_the_bitangent_up_the_picture) {
  Primitive primitive = square();
  make_tangents(primitive, {});
  expect_orthonormal(primitive);
  EXPECT_THAT(primitive.tangents, ::testing::Each(vec4(1, 0, 0, 1)));
}

TEST(Tangents, a_mirrored_texture_has_negative_handedness) {
  Primitive primitive = square();
  for (vec2& uv : primitive.uv0) uv.x = -uv.x;
  make_tangents(primitive, {});
  EXPECT_THAT(primitive.tangents, ::testing::Each(vec4(-1, 0, 0, -1)));
}

TEST(Tangents, a_vertex_between_mirrored_and_plain_faces_is_split) {
  Primitive primitive = square();
  // The second triangle's texture is mirrored across the diagonal it shares.
  primitive.uv0 = {vec2(0, 1), vec2(1, 1), vec2(1, 0), vec2(1, 1)};
  make_tangents(primitive, {});
  expect_orthonormal(primitive);
  ASSERT_EQ(primitive.positions.size(), 6u);
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(primitive.tangents[primitive.indices[static_cast<std::size_t>(corner)]].w, 1.0f);
    EXPECT_EQ(primitive.tangents[primitive.indices[static_cast<std::size_t>(3 + corner)]].w, -1.0f);
  }
  EXPECT_EQ(primitive.positions[primitive.indices[3]], vec3(0, 0, 0));
  EXPECT_EQ(primitive.positions[primitive.indices[4]], vec3(1, 1, 0));
}

TEST(Tangents, texture_coordinates_without_area_still_give_unit_tangents) {
  Primitive primitive = square();
  primitive.uv0.assign(4, vec2(0.5f, 0.5f));
  make_tangents(primitive, {});
  expect_orthonormal(primitive);
  primitive.uv0.clear();
  make_tangents(primitive, {});
  expect_orthonormal(primitive);
}

TEST(Tangents, follow_the_second_set_and_the_transform_of_the_normal_texture) {
  Primitive primitive = square();
  primitive.uv1 = primitive.uv0;
  primitive.uv0.assign(4, vec2(0.0f));
  TextureSlot slot;
  slot.uv_set = 1;
  // u' = v, v' = −u: a quarter turn.
  slot.transform_row0 = vec3(0, 1, 0);
  slot.transform_row1 = vec3(-1, 0, 0);
  make_tangents(primitive, slot);
  expect_orthonormal(primitive);
  for (const vec4& tangent : primitive.tangents) EXPECT_NEAR(glm::distance(tangent, vec4(0, -1, 0, 1)), 0.0f, 1e-6f);
}

TEST(Tangents, coordinates_near_the_end_of_float_do_not_overflow) {
  Primitive primitive = square();
  for (vec3& position : primitive.positions) position *= 1e37f;
  make_tangents(primitive, {});
  expect_orthonormal(primitive);
}

TEST(Tangents, given_ones_are_made_unit_length_across_the_normal) {
  Primitive primitive = square();
  primitive.tangents = {vec4(2, 0, 3, 0.5f), vec4(0, 0, 0, -1), vec4(0, 0, 7, 1), vec4(0, -4, 0, -3)};
  repair_tangents(primitive);
  expect_orthonormal(primitive);
  EXPECT_EQ(primitive.tangents[0], vec4(1, 0, 0, 1));
  EXPECT_EQ(primitive.tangents[3], vec4(0, -1, 0, -1));
}

}  // namespace
}  // namespace gloam::gltf
