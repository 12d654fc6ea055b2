// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/pictures/image_io.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sandbox/output/file_io.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace gloam {
namespace {

std::string temporary(const std::string& name) { return ::testing::TempDir() + "/gloam_image_io_" + name; }

TEST(ImageIo, a_png_reads_back_as_it_was) {
  constexpr std::uint32_t kWidth = 37;
  constexpr std::uint32_t kHeight = 23;
  std::vector<std::uint8_t> rgba;
  for (std::uint32_t i = 0; i < kWidth * kHeight * 4; ++i)
    rgba.push_back(static_cast<std::uint8_t>((i * 2654435761u) >> 24));
  const std::string path = temporary("picture.png");
  ASSERT_TRUE(write_png(path, kWidth, kHeight, rgba).ok());

  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* read = stbi_load(path.c_str(), &width, &height, &channels, 4);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(width, 37);
  EXPECT_EQ(height, 23);
  EXPECT_EQ(channels, 3);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rgba.size(); ++i) wrong += i % 4 == 3 ? read[i] != 255 : read[i] != rgba[i];
  EXPECT_EQ(wrong, 0u);
  stbi_image_free(read);
  std::filesystem::remove(path);
}

TEST(ImageIo, the_same_picture_gives_the_same_bytes) {
  const std::vector<std::uint8_t> rgba(64 * 64 * 4, 77);
  const std::string a = temporary("a.png");
  const std::string b = temporary("b.png");
  ASSERT_TRUE(write_png(a, 64, 64, rgba).ok());
  ASSERT_TRUE(write_png(b, 64, 64, rgba).ok());
  EXPECT_EQ(*read_text_file(a, ErrorKind::failed), *read_text_file(b, ErrorKind::failed));
  EXPECT_LT(std::filesystem::file_size(a), rgba.size() / 20);
  std::filesystem::remove(a);
  std::filesystem::remove(b);
}

TEST(ImageIo, an_exr_keeps_linear_light_to_the_bit) {
  const std::vector<float> rgba = {0.0f, 1e-6f, 65504.5f, 1.0f, 3.14159274f, 1e6f, 0.1f, 0.0f};
  const std::string path = temporary("light.exr");
  ASSERT_TRUE(write_exr(path, 2, 1, rgba).ok());

  Imf::InputFile file(path.c_str());
  std::vector<float> read(6);
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t channel = 0; channel < 3; ++channel)
    frame.insert(names[channel], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.data() + channel),
                                            3 * sizeof(float), 6 * sizeof(float)));
  file.setFrameBuffer(frame);
  file.readPixels(0);
  EXPECT_EQ(read, (std::vector<float>{0.0f, 1e-6f, 65504.5f, 3.14159274f, 1e6f, 0.1f}));
  std::filesystem::remove(path);
}

TEST(ImageIo, a_place_that_cannot_be_written_is_named) {
  const std::vector<std::uint8_t> bytes(4);
  const std::vector<float> floats(4);
  for (const Status& status :
       {write_png("/no/such/folder/a.png", 1, 1, bytes), write_exr("/no/such/folder/a.exr", 1, 1, floats)}) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::failed);
    EXPECT_NE(status.error().message.find("/no/such/folder/a."), std::string::npos);
  }
}

}  // namespace
}  // namespace gloam
