// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/outputs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/math/packing.h"

namespace gloam {
namespace {

TEST(DecodeGeometry, takes_channels_from_the_low_byte_up) {
  const GeometryTexel texel = decode_geometry(0xFF80'40FFu, {0, 0}, 0xFF00'80FFu);
  EXPECT_FLOAT_EQ(texel.base_color.r, 1.0f);
  EXPECT_NEAR(texel.base_color.g, std::pow(64.0 / 255.0, 2.0), 1e-6);
  EXPECT_NEAR(texel.base_color.b, std::pow(128.0 / 255.0, 2.0), 1e-6);
  EXPECT_TRUE(texel.subsurface);
  EXPECT_FLOAT_EQ(texel.roughness, 1.0f);
  EXPECT_NEAR(texel.metallic, 128.0 / 255.0, 1e-6);
  EXPECT_FLOAT_EQ(texel.occlusion, 0.0f);
  EXPECT_FLOAT_EQ(texel.reflectivity, 1.0f);
}

TEST(DecodeGeometry, subsurface_is_alpha_above_a_half) {
  EXPECT_FALSE(decode_geometry(0x0000'0000u, {0, 0}, 0).subsurface);
  EXPECT_FALSE(decode_geometry(0x7F00'0000u, {0, 0}, 0).subsurface);
  EXPECT_TRUE(decode_geometry(0x8000'0000u, {0, 0}, 0).subsurface);
}

TEST(DecodeGeometry, the_first_word_is_the_shading_normal) {
  const vec3 shading = glm::normalize(vec3(0.3f, 0.8f, -0.5f));
  const vec3 face = glm::normalize(vec3(-1.0f, 0.1f, 0.2f));
  const GeometryTexel texel = decode_geometry(0, {pack_normal_snorm16(shading), pack_normal_snorm16(face)}, 0);
  EXPECT_GT(glm::dot(texel.normal, shading), 0.9999999f);
  EXPECT_GT(glm::dot(texel.face_normal, face), 0.9999999f);
}

TEST(DecodeSmoothSurface, holds_a_length_a_direction_and_a_normal) {
  const vec3 normal = glm::normalize(vec3(0.3f, 0.8f, -0.5f));
  const std::uint32_t quarter = std::uint32_t{float_to_half(0.25f)} << 16;
  const auto along_x = decode_smooth_surface({pack_normal_snorm16(normal), quarter | 128u << 8 | 255u});
  EXPECT_TRUE(along_x.exists);
  EXPECT_EQ(along_x.offset, vec3(0.25f, 0.0f, 0.0f));
  EXPECT_GT(glm::dot(along_x.normal, normal), 0.9999999f);
  EXPECT_EQ(decode_smooth_surface({0, quarter | 1u << 8 | 128u}).offset, vec3(0.0f, -0.25f, 0.0f));
  EXPECT_EQ(decode_smooth_surface({0, quarter | 128u << 8 | 128u}).offset, vec3(0.0f, 0.0f, 0.25f));
  EXPECT_TRUE(decode_smooth_surface({0, 128u << 8 | 128u}).exists) << "at a vertex";
  EXPECT_FALSE(decode_smooth_surface({pack_normal_snorm16(normal), 0}).exists);
}

}  // namespace
}  // namespace gloam
