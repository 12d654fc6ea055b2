// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/image_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "engine/scene/decoding/png_rows.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kColor[4] = {200, 100, 50, 255};

std::vector<std::uint8_t> noise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 13);
  return bytes;
}

TEST(ImageFile, png_pixels_come_back_exactly_under_every_filter) {
  for (int filter = 0; filter < 5; ++filter) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (const int width : {1, 2, 3, 17, 64}) {
        constexpr int kHeight = 5;
        const auto pixels = noise(static_cast<std::size_t>(width * kHeight * channels), 7);
        const Result<Image> image = decode_image(test::encode_png(width, kHeight, channels, pixels, filter));
        ASSERT_TRUE(image.ok()) << image.error().message;
        ASSERT_EQ(image->rgba.size(), static_cast<std::size_t>(width * kHeight * 4));
        for (std::size_t i = 0; i < image->rgba.size(); ++i) {
          const std::size_t pixel = i / 4 * static_cast<std::size_t>(channels);
          const std::size_t colors = channels > 2 ? 3 : 1;
          const bool alpha = i % 4 == 3;
          const std::uint8_t wanted =
              alpha ? (channels % 2 == 0 ? pixels[pixel + colors] : 255) : pixels[pixel + (colors == 3 ? i % 4 : 0)];
          ASSERT_EQ(image->rgba[i], wanted) << "filter " << filter << ", channels " << channels << ", byte " << i;
        }
      }
    }
  }
}

TEST(ImageFile, jpeg_comes_back_nearly) {
  const Result<Image> image = decode_image(test::make_jpeg(16, 8, kColor));
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(image->width, 16u);
  EXPECT_EQ(image->height, 8u);
  for (std::size_t i = 0; i < image->rgba.size(); ++i) EXPECT_NEAR(image->rgba[i], kColor[i % 4], 6);
}

// Hard case: scene.no_image
TEST(ImageFile, other_formats_are_refused) {
  EXPECT_EQ(decode_image({}).error().message, "is not a PNG, JPEG or WebP image");
  const std::string gif = "GIF89a\1\0\1\0\0\0\0;not an image at all";
  const Bytes bytes(gif.begin(), gif.end());
  EXPECT_EQ(decode_image(bytes).error().message, "is not a PNG, JPEG or WebP image");
}

TEST(ImageFile, a_cut_file_is_refused_or_a_picture_at_every_length) {
  const Bytes png = test::make_png(20, 20, kColor);
  const Bytes jpeg = test::make_jpeg(20, 20, kColor);
  // A PNG that lacks only its last checksum counts as whole.
  for (std::size_t size = 0; size + 4 < png.size(); ++size)
    EXPECT_FALSE(decode_image(std::span(png).first(size)).ok()) << size;
  for (std::size_t size = 0; size < jpeg.size(); ++size) {
    // JPEG decoders fill in missing data.
    const Result<Image> image = decode_image(std::span(jpeg).first(size));
    if (image.ok()) {
      EXPECT_EQ(image->rgba.size(), 20u * 20 * 4);
    }
  }
}

TEST(ImageFile, gigantic_sizes_are_refused_before_any_memory_is_taken) {
  Bytes png = test::make_png(4, 4, kColor);
  const auto set_size = [&png](std::uint32_t width, std::uint32_t height) {
    for (int i = 0; i < 4; ++i) {
      png[16 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(width >> (24 - 8 * i));
      png[20 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(height >> (24 - 8 * i));
    }
  };
  set_size(16384, 16384);
  EXPECT_THAT(image_size(png).error().message, HasSubstr("16384×16384 pixels, more than its bytes can hold"));
  set_size(16385, 4);
  EXPECT_THAT(image_size(png).error().message, HasSubstr("16384"));
  set_size(0x7fffffff, 0x7fffffff);
  EXPECT_FALSE(image_size(png).ok());
  set_size(0, 0);
  EXPECT_FALSE(image_size(png).ok());
}

TEST(ImageFile, a_progressive_jpeg_of_thousands_of_scans_is_refused) {
  Bytes jpeg = {0xff, 0xd8, 0xff, 0xc2, 0, 17, 8, 4, 0, 4, 0, 3, 1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0};  // 1024×1024
  jpeg.resize(jpeg.size() + 4096);
  const Result<ImageSize> size = image_size(jpeg);
  ASSERT_TRUE(size.ok()) << size.error().message;
  EXPECT_EQ(size->work(), 1024u * 1024u);
  for (int scan = 0; scan < 2000; ++scan) jpeg.insert(jpeg.end(), {0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0, 0x55});
  EXPECT_EQ(decode_image(jpeg).error().message, "has 2000 scans of 1024×1024 pixels, more work than its bytes justify");
}

TEST(ImageFile, a_jpeg_whose_huffman_table_has_too_many_codes_is_refused) {
  Bytes jpeg = test::make_jpeg(16, 8, kColor);
  const Bytes marker = {0xff, 0xc4};
  const auto tables = std::search(jpeg.begin(), jpeg.end(), marker.begin(), marker.end());
  ASSERT_NE(tables, jpeg.end());
  // Behind marker, length and the table's number: 16 counts of codes.
  for (int i = 0; i < 2; ++i) tables[5 + 14 + i] = 150;
  EXPECT_EQ(decode_image(jpeg).error().message, "is a damaged image (a Huffman table has more than 256 codes)");
}

TEST(ImageFile, a_png_with_an_unknown_critical_chunk_or_without_its_end_is_refused) {
  const Bytes png = test::make_png(5, 3, kColor);
  ASSERT_TRUE(decode_image(png).ok());
  const Bytes marker = {'I', 'E', 'N', 'D'};
  const auto end = std::search(png.begin(), png.end(), marker.begin(), marker.end()) - png.begin();
  Bytes unknown = png;
  unknown[static_cast<std::size_t>(end)] = '\n';
  EXPECT_EQ(decode_image(unknown).error().message, "is a damaged image (it has an unknown critical chunk)");
  const Bytes cut(png.begin(), png.begin() + end);
  EXPECT_EQ(decode_image(cut).error().message, "is a damaged image (it ends before its last chunk)");
}

TEST(ImageFile, a_huffman_table_before_the_header_is_checked_first) {
  Bytes jpeg = test::make_jpeg(16, 8, kColor);
  Bytes table = {0xff, 0xc4, 0, 19, 0};
  for (int i = 0; i < 16; ++i) table.push_back(i < 2 ? 200 : 0);
  jpeg.insert(jpeg.begin() + 2, table.begin(), table.end());
  EXPECT_EQ(image_size(jpeg).error().message, "is a damaged image (a Huffman table has more than 256 codes)");
}

TEST(ImageFile, a_jpeg_without_tables_is_refused_or_a_picture) {
  const Bytes whole = test::make_jpeg(16, 8, kColor);
  for (const std::uint8_t marker : {std::uint8_t{0xc4}, std::uint8_t{0xdb}}) {
    Bytes jpeg = whole;
    for (std::size_t i = 2; i + 1 < jpeg.size(); ++i)
      if (jpeg[i] == 0xff && jpeg[i + 1] == marker) jpeg[i + 1] = 0xfe;  // a comment
    const Result<Image> first = decode_image(jpeg);
    const Result<Image> second = decode_image(jpeg);
    ASSERT_EQ(first.ok(), second.ok());
    if (first.ok()) {
      EXPECT_EQ(first->rgba, second->rgba);
    }
  }
}

TEST(PngRows, an_unknown_filter_is_refused) {
  Bytes rows(2 * (3 * 2 + 1) + kPngRowPadding);
  Bytes rgba(2 * 2 * 4);
  EXPECT_TRUE(unfilter_png_rows(rows, 2, 2, 3, rgba));
  rows[7] = 5;
  EXPECT_FALSE(unfilter_png_rows(rows, 2, 2, 3, rgba));
}

}  // namespace
}  // namespace gloam
