// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/proxy_texture.h"

#include <gmock/gmock.h>

#include "tests/modules/reflections/bake/bake_world.h"
#include "tests/modules/reflections/bake/small_png.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

TEST(ProxyTexture, is_linear_light_premultiplied_by_alpha) {
  const test::TestFolder folder;
  test::write_small_png(folder.path() + "/small.png");
  const auto picture = read_proxy_texture(folder.path() + "/small.png", 2);
  ASSERT_TRUE(picture.ok());
  const float alpha = 128.0f / 255.0f;
  EXPECT_EQ(picture->texels[0], vec4(1, 0, 0, 1));
  EXPECT_NEAR(picture->texels[1].x, 0.503f * alpha, 1e-3f);
  EXPECT_FLOAT_EQ(picture->texels[1].w, alpha);
  EXPECT_EQ(picture->texels[2], vec4(0.0f));
  EXPECT_EQ(picture->texels[3], vec4(0, 1, 0, 1));
}

TEST(ProxyTexture, that_cannot_be_read_is_an_input_error_that_names_key_and_file) {
  const auto picture = read_proxy_texture("absent.png", 2);
  ASSERT_FALSE(picture.ok());
  EXPECT_EQ(picture.error().kind, ErrorKind::input);
  EXPECT_THAT(picture.error().message, HasSubstr("gloam.ibr_proxy.texture"));
  EXPECT_THAT(picture.error().message, HasSubstr("absent.png"));
}

TEST(ProxyTexture, of_a_fire_has_the_intensity_of_its_lights) {
  test::BakeWorld base;
  Light flame;
  flame.intensity = 30.0f;
  const Entity first = base.light("first", flame, dmat4(1.0));
  flame.color = vec3(0.0f, 0.5f, 0.0f);
  const Entity second = base.light("second", flame, dmat4(1.0));
  base.light("other", flame, dmat4(1.0));
  CapturedPicture picture{2, 1, {vec4(0.2f, 0.1f, 0.0f, 0.5f), vec4(0.0f)}};
  const std::vector<CapturedProxyLight> chosen = {{0, first, 0.5f}, {0, second, 0.5f}};
  const double area = 1.17;
  scale_to_lights(picture, area, light_sources(base.world), chosen, 1.0f);
  double candela = 0.0;
  for (const vec4& texel : picture.texels) candela += luminance_of(dvec3(texel)) * area / 2.0;
  EXPECT_NEAR(candela, 30.0 + 15.0 * 0.7152, 1e-3);
  EXPECT_NEAR(picture.texels[0].x, 2.0f * picture.texels[0].y, 1e-4f);
  EXPECT_EQ(picture.texels[0].w, 0.5f);
}

TEST(ProxyTexture, of_a_black_fire_stays_black) {
  CapturedPicture picture{1, 1, {vec4(0.0f)}};
  scale_to_lights(picture, 1.0, {}, {}, 1.0f);
  EXPECT_EQ(picture.texels[0], vec4(0.0f));
}

}  // namespace
}  // namespace gloam
