// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/filter/cookies.h"

#include <gmock/gmock.h>

#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/shadows/components.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

TEST(ShadowCookies, a_picture_of_one_color_stays_so) {
  for (const std::uint32_t side : {1u, 3u, 512u, 700u}) {
    Image image{"", side, side, std::vector<std::uint8_t>(std::size_t{side} * side * 4, 77)};
    const auto texels = resampled_cookie(image);
    ASSERT_EQ(texels.size(), std::size_t{kCookieSide} * kCookieSide * 4);
    for (std::size_t i = 0; i < texels.size(); i += 4) ASSERT_EQ(texels[i], 77) << side;
  }
}

TEST(ShadowCookies, one_of_the_size_it_has_on_the_gpu_is_copied) {
  Image image{"", kCookieSide, kCookieSide, {}};
  for (std::size_t i = 0; i < std::size_t{kCookieSide} * kCookieSide * 4; ++i)
    image.rgba.push_back(i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(i * 37 % 251));
  EXPECT_EQ(resampled_cookie(image), image.rgba);
}

TEST(ShadowCookies, smaller_texels_are_averaged_in_linear_light) {
  Image image{"", 1024, 4, {}};
  for (std::uint32_t i = 0; i < 1024 * 4; ++i) {
    const std::uint8_t value = i % 2 == 0 ? 255 : 0;
    image.rgba.insert(image.rgba.end(), {value, value, value, 255});
  }
  const auto texels = resampled_cookie(image);
  // Half of the linear light is 188 of 255 in sRGB.
  for (std::size_t x = 4; x < kCookieSide - 4; ++x) EXPECT_NEAR(texels[4 * x], 188, 1);
}

TEST(ShadowCookies, a_file_that_is_no_picture_is_an_input_error_that_names_it) {
  test::TemporaryFolder folder;
  const std::string path = folder.write("cookie.png", "not a picture");
  World world;
  prepare_scene_world(world);
  world.register_component<Light>("light");
  Light light;
  light.kind = LightKind::spot;
  light.cookie = world.resource<SceneStrings>().intern(path);
  world.create(light);
  const Status status = load_cookies(world);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::input);
  EXPECT_THAT(status.error().message, HasSubstr("cookie.png"));
  EXPECT_THAT(status.error().message, HasSubstr("gloam.light.cookie"));
  EXPECT_TRUE(load_cookies(world).ok());  // reported once; the cookie is white
  const Cookies& cookies = world.resource<Cookies>();
  ASSERT_EQ(cookies.texels.size(), 1u);
  EXPECT_EQ(cookies.texels[0][0], 255);
}

TEST(ShadowCookies, points_and_suns_have_none) {
  World world;
  prepare_scene_world(world);
  world.register_component<Light>("light");
  Light light;
  light.cookie = world.resource<SceneStrings>().intern("absent.png");
  world.create(light);
  EXPECT_TRUE(load_cookies(world).ok());
  EXPECT_TRUE(world.resource<Cookies>().texels.empty());
}

}  // namespace
}  // namespace gloam
