// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/webp_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "engine/scene/decoding/image_file.h"
#include "tests/support/gltf_files.h"
#include "tests/support/scale.h"
#include "tests/support/webp_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

Bytes random_pixels(int width, int height) {
  std::mt19937 random(3);
  Bytes pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  for (std::uint8_t& value : pixels) value = static_cast<std::uint8_t>(random() >> 11);
  return pixels;
}

/// A smooth picture with a smooth alpha.
Bytes ramp(int width, int height) {
  Bytes pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {x * 255 / width, y * 255 / height, 128, 255 - x * 200 / width})
        pixels.push_back(static_cast<std::uint8_t>(value));
  return pixels;
}

// Hard case: scene.webp
TEST(WebpFile, lossless_pixels_are_those_of_the_same_png) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 5), std::pair(64, 33)}) {
    const Bytes pixels = random_pixels(width, height);
    const Result<Image> webp = decode_image(test::encode_webp(width, height, pixels));
    const Result<Image> png = decode_image(test::encode_png(width, height, 4, pixels));
    ASSERT_TRUE(webp.ok()) << webp.error().message;
    EXPECT_EQ(webp->width, png->width);
    EXPECT_EQ(webp->height, png->height);
    EXPECT_EQ(webp->rgba, png->rgba);
  }
}

TEST(WebpFile, lossy_pixels_are_near_and_keep_their_alpha) {
  constexpr int kWidth = 96, kHeight = 64;
  const Bytes pixels = ramp(kWidth, kHeight);
  const Bytes file = test::encode_webp(kWidth, kHeight, pixels, 90.0f);
  EXPECT_NE(file, test::encode_webp(kWidth, kHeight, pixels));
  const Result<Image> image = decode_image(file);
  ASSERT_TRUE(image.ok()) << image.error().message;
  double difference = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % 4 == 3) {
      ASSERT_EQ(image->rgba[i], pixels[i]) << i;  // alpha is always lossless at quality 100, the encoder's default
    } else {
      difference += std::abs(image->rgba[i] - pixels[i]);
    }
  }
  EXPECT_LT(difference / (kWidth * kHeight * 3), 3.0);
}

// Hard case: scene.damaged_webp
TEST(WebpFile, a_file_cut_anywhere_is_refused_and_one_with_changed_bytes_is_a_picture_or_refused) {
  std::mt19937 random(7);
  for (const float quality : {-1.0f, 60.0f}) {
    const Bytes file = test::encode_webp(40, 24, random_pixels(40, 24), quality);
    for (std::size_t size = 0; size + 1 < file.size(); ++size)
      EXPECT_FALSE(decode_image(std::span(file).first(size)).ok()) << size << " of " << file.size();
    for (int i = 0; i < test::scaled(300); ++i) {
      Bytes changed = file;
      for (int k = 0; k < 3; ++k) {
        const std::size_t at = 12 + random() % (i % 3 == 0 ? 40 : file.size() - 12);
        if (at < 21 || at > 30) changed[at] = static_cast<std::uint8_t>(random());  // its size stays
      }
      const Result<Image> image = decode_image(changed);
      if (!image.ok()) {
        EXPECT_THAT(image.error().message, ::testing::StartsWith("is "));
      }
    }
  }
}

TEST(WebpFile, an_animation_is_refused) {
  const Bytes pixels = random_pixels(4, 4);
  EXPECT_EQ(decode_image(test::animate_webp(4, 4, test::encode_webp(4, 4, pixels))).error().message,
            "is an animated WebP image, only still images are read");
}

TEST(WebpFile, a_header_of_a_gigantic_picture_takes_no_memory_before_the_scene_is_counted) {
  Bytes file = test::encode_webp(4, 4, random_pixels(4, 4));
  // Lossless: after RIFF, size, WEBP, VP8L, size and 0x2f, 14 bits of width − 1 and 14 bits of height − 1.
  for (int i = 21; i < 25; ++i) file[static_cast<std::size_t>(i)] |= i < 24 ? 0xff : 0x0f;
  const Result<ImageSize> size = image_size(file);
  ASSERT_TRUE(size.ok()) << size.error().message;
  EXPECT_EQ(size->pixels(), 16384u * 16384u);
  GltfText gltf;
  for (int i = 0; i < 2; ++i)
    gltf.add("images", R"({"mimeType": "image/webp", "bufferView": )" + std::to_string(gltf.view_of(file)) + "}");
  Import import;
  test::import_text(gltf.text(), import);
  EXPECT_THAT(import.fault(), HasSubstr("image 1: the scene's images up to here have 536870912 pixels"));
}

std::string texture_of(const std::string& members) { return "{" + members + "}"; }

const std::string kWebpSource = R"("extensions": {"EXT_texture_webp": {"source": 0}})";

TEST(WebpTexture, takes_the_image_of_the_extension_and_leaves_the_fallback_closed) {
  const Bytes pixels = random_pixels(5, 3);
  const Bytes file = test::encode_webp(5, 3, pixels);
  const test::TemporaryFolder folder;
  folder.write("a.webp", file);
  GltfText gltf;
  const std::string embedded = R"({"uri": "data:image/webp;base64,)" + test::base64(file) + "\"}";
  const std::string in_buffer =
      R"({"mimeType": "image/webp", "bufferView": )" + std::to_string(gltf.view_of(file)) + "}";
  for (const std::string& image : {std::string(R"({"uri": "a.webp"})"), embedded, in_buffer}) {
    for (const bool required : {true, false}) {
      GltfText scene = gltf;
      scene.set(required ? "extensionsRequired" : "extensionsUsed", R"(["EXT_texture_webp"])");
      scene.add("images", image);
      if (!required) scene.add("images", R"({"uri": "absent.png"})");
      scene.add("textures", texture_of(kWebpSource + (required ? "" : R"(, "source": 1)")));
      scene.add("materials", R"({"emissiveTexture": {"index": 0}})");
      scene.add("nodes", "{}");
      Import import;
      test::import_file(folder.write("scene.gltf", scene.text()), import);
      ASSERT_EQ(import.fault(), "");
      EXPECT_THAT(import.info().warnings, IsEmpty());
      const SceneAssets& assets = import.world.resource<SceneAssets>();
      ASSERT_EQ(assets.images.size(), 1u);
      EXPECT_EQ(assets.images[0].rgba, pixels);
      EXPECT_EQ(assets.textures[assets.materials[0].emissive_texture.texture].image, 0u);
    }
  }
}

TEST(WebpTexture, a_fallback_that_another_texture_shows_is_read) {
  const std::uint8_t red[4] = {255, 0, 0, 255};
  GltfText gltf;
  gltf.add("images",
           R"({"uri": "data:image/webp;base64,)" + test::base64(test::encode_webp(2, 2, random_pixels(2, 2))) + "\"}");
  gltf.add("images", R"({"uri": "data:image/png;base64,)" + test::base64(test::make_png(1, 1, red)) + "\"}");
  gltf.add("textures", texture_of(kWebpSource + R"(, "source": 1)"));
  gltf.add("textures", R"({"source": 1})");
  gltf.add("textures", R"({"source": 1, "extensions": {"EXT_texture_webp": {}}})");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  std::vector<std::uint32_t> images;
  for (const Texture& texture : import.world.resource<SceneAssets>().textures) images.push_back(texture.image);
  EXPECT_THAT(images, ElementsAre(0, 1, 1));
}

TEST(WebpTexture, a_broken_webp_is_refused_although_there_is_a_fallback) {
  const std::uint8_t red[4] = {255, 0, 0, 255};
  Bytes file = test::encode_webp(20, 20, random_pixels(20, 20));
  file.resize(file.size() / 2);
  GltfText gltf;
  gltf.add("images", R"({"mimeType": "image/webp", "bufferView": )" + std::to_string(gltf.view_of(file)) + "}");
  gltf.add("images", R"({"uri": "data:image/png;base64,)" + test::base64(test::make_png(1, 1, red)) + "\"}");
  gltf.add("textures", texture_of(kWebpSource + R"(, "source": 1)"));
  Import import;
  test::import_text(gltf.text(), import);
  EXPECT_EQ(import.fault(), "scene.gltf: image 0: is a damaged image (its WebP data end early or are wrong)");
}

}  // namespace
}  // namespace gloam
