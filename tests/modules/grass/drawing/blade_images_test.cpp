// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/blade_images.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/scene/resources.h"
#include "modules/grass/drawing/textures.h"
#include "tests/support/gltf_files.h"

namespace gloam::test {
namespace {

using ::testing::HasSubstr;

Image noise(std::uint32_t width, std::uint32_t height, std::uint32_t seed, bool opaque) {
  std::mt19937 random(seed);
  Image image{"", width, height, {}};
  for (std::size_t i = 0; i < std::size_t{width} * height * 4; ++i)
    image.rgba.push_back(i % 4 == 3 && opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(random() & 0xFFu));
  return image;
}

std::vector<BladeImage> layers_in(const Image& image, std::uint32_t count) {
  auto layers = blade_layers(image, count);
  EXPECT_TRUE(layers.ok()) << (layers.ok() ? "" : layers.error().message);
  return layers.ok() ? std::move(*layers) : std::vector<BladeImage>(1);
}

/// Mean of what a rectangle of sRGB texels shows, linear and weighted by alpha, and its mean alpha.
dvec4 mean_of(const std::uint8_t* rgba, std::uint32_t stride, std::uint32_t width, std::uint32_t height) {
  dvec4 sum(0.0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint8_t* texel = rgba + 4 * (std::size_t{y} * stride + x);
      const double alpha = texel[3] / 255.0;
      for (int c = 0; c < 3; ++c) sum[c] += alpha * srgb_to_linear(texel[c] / 255.0);
      sum.w += alpha;
    }
  return {sum.x / sum.w, sum.y / sum.w, sum.z / sum.w, sum.w / static_cast<double>(std::size_t{width} * height)};
}

TEST(BladeImages, one_of_the_size_it_has_on_the_gpu_is_copied) {
  const Image image = noise(4, 32, 1, true);
  const BladeArray array = blade_array(layers_in(image, 1));
  ASSERT_EQ(uvec2(array.width, array.height), uvec2(4, 32));
  EXPECT_EQ(array.mips, 6u);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) ASSERT_EQ(array.texels[i], image.rgba[i]) << i;
}

// Hard case: grass.texture_mips
TEST(BladeImages, all_mips_keep_the_mean_colour_and_alpha) {
  for (const bool opaque : {true, false})
    for (const uvec2 size : {uvec2(1, 1), {3, 5}, {64, 64}, {37, 700}, {300, 90}, {129, 2000}}) {
      const Image image = noise(size.x, size.y, size.x, opaque);
      const dvec4 wanted = mean_of(image.rgba.data(), size.x, size.x, size.y);
      const BladeArray array = blade_array(layers_in(image, 1));
      for (std::uint32_t mip = 0; mip < array.mips; ++mip) {
        const std::uint32_t width = array.mip_width(mip);
        const dvec4 found = mean_of(&array.texels[array.mip_offset(mip)], width, width, array.mip_height(mip));
        for (int c = 0; c < 4; ++c)
          ASSERT_NEAR(found[c], wanted[c], 0.01) << size.x << "x" << size.y << " mip " << mip << " channel " << c;
      }
    }
}

TEST(BladeImages, what_alpha_hides_shows_in_no_mip) {
  Image image{"", 16, 128, {}};  // a green stripe between magenta that alpha hides
  for (std::uint32_t i = 0; i < 16 * 128; ++i) {
    const bool shown = i % 16 == 7;
    const std::uint8_t other = shown ? 0 : 255, green = shown ? 200 : 0;
    image.rgba.insert(image.rgba.end(), {other, green, other, static_cast<std::uint8_t>(shown ? 255 : 0)});
  }
  const BladeArray array = blade_array(layers_in(image, 1));
  for (std::size_t i = 0; i < array.texels.size(); i += 4) {
    ASSERT_EQ(array.texels[i], 0) << i;
    ASSERT_NEAR(array.texels[i + 1], 200, 1) << i;
  }
}

TEST(BladeImages, layers_lie_side_by_side) {
  Image image{"", 12, 4, {}};
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 12; ++x)
      image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(80 * (x / 4)), 0, 0, 255});
  for (const std::uint32_t count : {0u, 3u}) {
    const BladeArray array = blade_array(layers_in(image, count));
    ASSERT_EQ(array.layers, 3u);
    for (std::uint32_t mip = 0; mip < array.mips; ++mip)
      for (std::uint32_t layer = 0; layer < 3; ++layer)
        for (std::size_t i = 0; i < array.layer_bytes(mip); i += 4)
          ASSERT_EQ(array.texels[array.mip_offset(mip) + layer * array.layer_bytes(mip) + i], 80 * layer) << mip;
  }
  EXPECT_EQ(layers_in(image, 1).size(), 1u);
  EXPECT_EQ(layers_in(image, 12).size(), 12u);
}

TEST(BladeImages, the_sides_tell_the_layers_if_they_are_square) {
  for (const auto& [size, layers] : {std::pair{uvec2(1, 1), 1u},
                                     {{64, 64}, 1},
                                     {{8, 512}, 1},
                                     {{128, 64}, 2},
                                     {{100, 64}, 1},
                                     {{1024, 64}, 16},
                                     {{63, 64}, 1}})
    EXPECT_EQ(layers_in(noise(size.x, size.y, 1, true), 0).size(), layers) << size.x << "x" << size.y;
}

TEST(BladeImages, other_layers_than_the_image_can_have_are_refused_in_one_sentence) {
  const auto many = blade_layers(noise(64, 1, 1, true), 0);
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().message,
            "the image of 64 x 1 pixels has 64 layers side by side, and at most 16 are possible; "
            "gloam.grass.texture_layers says how many it has");
  const auto uneven = blade_layers(noise(64, 64, 1, true), 3);
  ASSERT_FALSE(uneven.ok());
  EXPECT_THAT(uneven.error().message, HasSubstr("no width for 3 layers of whole pixels"));
  EXPECT_EQ(uneven.error().kind, ErrorKind::input);
}

// Hard case: grass.texture_huge
TEST(BladeImages, sizes_have_limits) {
  const BladeArray huge = blade_array(layers_in(noise(2048, 5000, 1, true), 2));
  EXPECT_EQ(uvec2(huge.width, huge.height), uvec2(kMostBladeWidth, kMostBladeHeight));
  const BladeArray wide = blade_array(layers_in(noise(128, 128, 1, true), 1));
  EXPECT_EQ(uvec2(wide.width, wide.height), uvec2(128, 1024)) << "rows are left where a mip is one texel wide";
  const BladeArray tiny = blade_array(layers_in(noise(1, 1, 1, true), 1));
  EXPECT_EQ(uvec2(tiny.width, tiny.height), uvec2(1, 8));
}

/// A world with surfaces that name files of a folder.
class BladeTextureFiles : public ::testing::Test {
 protected:
  BladeTextureFiles() {
    prepare_scene_world(world);
    world.register_component<GrassSurface>("grass_surface");
  }
  std::uint32_t file(const std::string& name, std::uint32_t width, std::uint32_t height) {
    const Image image = noise(width, height, 1, true);
    return world.resource<SceneStrings>().intern(
        folder.write(name, encode_png(static_cast<int>(width), static_cast<int>(height), 4, image.rgba)));
  }
  GrassSurface surface(std::uint32_t texture, std::uint32_t layers = 0) {
    GrassSurface values;
    values.density = 1.0f;
    values.texture = texture;
    values.texture_layers = layers;
    world.create(values);
    return values;
  }
  const BladeTextures& textures() { return world.resource<BladeTextures>(); }

  TemporaryFolder folder;
  World world;
};

TEST_F(BladeTextureFiles, no_image_is_no_array) {
  surface(0);
  ASSERT_TRUE(load_blade_textures(world).ok());
  EXPECT_EQ(textures().array, nullptr);
  EXPECT_FALSE(has_blade_textures(world));
}

TEST_F(BladeTextureFiles, surfaces_share_an_image_and_have_their_own_layers) {
  const std::uint32_t one = file("one.png", 4, 64), sheet = file("sheet.png", 24, 8);
  const GrassSurface a = surface(one), b = surface(sheet), c = surface(sheet), d = surface(sheet, 2);
  ASSERT_TRUE(load_blade_textures(world).ok());
  EXPECT_EQ(textures().array->layers, 6u);
  EXPECT_EQ(layers_of(textures(), a).count, 1u);
  EXPECT_EQ(layers_of(textures(), b).count, 3u);
  EXPECT_EQ(layers_of(textures(), c).first, layers_of(textures(), b).first);
  EXPECT_EQ(layers_of(textures(), d).count, 2u);
  EXPECT_NE(layers_of(textures(), d).first, layers_of(textures(), b).first);
  EXPECT_EQ(uvec2(textures().array->width, textures().array->height), uvec2(16, 128)) << "sides of the largest";
  const std::uint64_t version = textures().version;
  ASSERT_TRUE(load_blade_textures(world).ok());
  EXPECT_EQ(textures().version, version);
  surface(file("later.png", 8, 8));
  ASSERT_TRUE(load_blade_textures(world).ok());
  EXPECT_EQ(textures().array->layers, 7u);
  EXPECT_GT(textures().version, version);
}

// Hard case: grass.texture_missing
TEST_F(BladeTextureFiles, an_absent_or_broken_file_is_an_input_error_that_names_it) {
  for (const std::string name : {"absent.png", "broken.png"}) {
    if (name == "broken.png") static_cast<void>(folder.write(name, "no picture"));
    const std::string path = folder.path() + "/" + name;
    const GrassSurface bad = surface(world.resource<SceneStrings>().intern(path));
    const GrassSurface good = surface(file("good.png", 4, 4));
    const Status status = load_blade_textures(world);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::input);
    EXPECT_THAT(status.error().message, HasSubstr("gloam.grass.texture: " + folder.path()));
    EXPECT_EQ(layers_of(textures(), bad).count, 0u) << "procedural colours";
    EXPECT_EQ(layers_of(textures(), good).count, 1u);
    EXPECT_TRUE(load_blade_textures(world).ok()) << "reported once";
  }
  EXPECT_EQ(textures().faults.size(), 2u);
}

TEST_F(BladeTextureFiles, more_layers_than_a_scene_may_have_are_refused) {
  for (std::uint32_t i = 0; i < 5; ++i) surface(file("sheet" + std::to_string(i) + ".png", 16, 1));
  const Status status = load_blade_textures(world);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("images of blades have more than 64 layers in all"));
  EXPECT_EQ(textures().array->layers, kMostBladeLayers);
}

}  // namespace
}  // namespace gloam::test
