// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/readback/geometry_picture.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/math/packing.h"
#include "tests/support/render_scene.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

TEST(GeometryPicture, positions_lie_where_the_matrix_has_put_them) {
  std::mt19937 random(3);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto below = [&](std::uint32_t end) {
    return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random);
  };
  for (int round = 0; round < test::scaled(3000); ++round) {
    const dvec3 eye(in(-1e5, 1e5), in(-1e5, 1e5), in(-1e5, 1e5));
    ViewSettings settings =
        test::look_at(eye, eye + dvec3(in(-1, 1), in(-1, 1), in(0.1, 1)), 1 + below(300), 1 + below(300));
    settings.camera.fov_y = static_cast<float>(in(0.1, 2.0));
    settings.camera.near_m = static_cast<float>(in(0.01, 1.0));
    settings.camera.orthographic = round % 4 == 0;
    settings.camera.half_height_m = static_cast<float>(in(1.0, 20.0));
    settings.camera.far_m = 200.0f;
    GeometryPicture picture;
    picture.view = make_view(settings, 0);
    picture.depth.assign(std::size_t{settings.width} * settings.height, 0.0f);
    const std::uint32_t x = below(settings.width), y = below(settings.height);
    const std::size_t at = std::size_t{y} * settings.width + x;
    picture.depth[at] = static_cast<float>(in(0.001, 1.0));
    ASSERT_FALSE(picture.is_sky(at));
    const dvec3 position = picture.position(x, y);
    const dvec4 clip = dmat4(picture.view.clip_from_relative) * dvec4(position, 1.0);
    ASSERT_GT(clip.w, 0.0) << "in front of the camera";
    ASSERT_NEAR((clip.x / clip.w + 1.0) * 0.5 * settings.width, x + 0.5, 1e-7);
    ASSERT_NEAR((1.0 - clip.y / clip.w) * 0.5 * settings.height, y + 0.5, 1e-7);
    ASSERT_NEAR(clip.z / clip.w, static_cast<double>(picture.depth[at]), 1e-9);
    const double along = -glm::dot(dvec3(glm::transpose(picture.view.view_from_relative)[2]), position);
    const double expected = static_cast<double>(picture.view.view_depth(picture.depth[at]));
    ASSERT_NEAR(along, expected, 1e-5 * expected + 1e-4);
  }
}

// Hard case: further.depth_0
TEST(GeometryPicture, texels_decode_and_zero_depth_is_sky) {
  GeometryPicture picture;
  picture.depth = {0.0f, 0.5f};
  picture.base_color = {0u, 0xFF0000FFu};
  picture.normals = {uvec2(0u), uvec2(pack_normal_snorm16(vec3(0, 1, 0)), pack_normal_snorm16(vec3(0, 0, 1)))};
  picture.material = {0u, 0x00FF00FFu};
  EXPECT_TRUE(picture.is_sky(0));
  EXPECT_FALSE(picture.is_sky(1));
  const GeometryTexel texel = picture.texel(1);
  EXPECT_EQ(texel.base_color, vec3(1.0f, 0.0f, 0.0f));
  EXPECT_TRUE(texel.subsurface);
  EXPECT_LT(glm::length(texel.normal - vec3(0, 1, 0)), 1e-4f);
  EXPECT_LT(glm::length(texel.face_normal - vec3(0, 0, 1)), 1e-4f);
}

}  // namespace
}  // namespace gloam
