// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/view_values.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

template <class T, std::size_t N>
ImageBytes image_of(gpu::Format format, const std::array<T, N>& items) {
  ImageBytes image{2, 1, format, std::vector<std::byte>(sizeof(items))};
  std::memcpy(image.bytes.data(), items.data(), sizeof(items));
  return image;
}

TEST(TexelsAsFloats, decodes_what_visualizers_write) {
  const auto bytes =
      texels_as_floats(image_of<std::uint8_t, 8>(gpu::Format::rgba8_unorm, {0, 255, 51, 255, 1, 2, 3, 4}));
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ((*bytes)[1], 1.0f);
  EXPECT_NEAR((*bytes)[2], 0.2f, 1e-6f);
  const auto halves = texels_as_floats(image_of<std::uint16_t, 2>(gpu::Format::r16_float, {0x3C00, 0xC500}));
  ASSERT_TRUE(halves.ok());
  EXPECT_EQ(*halves, (std::vector<float>{1.0f, 0.0f, 0.0f, 0.0f, -5.0f, 0.0f, 0.0f, 0.0f}));
  const auto pairs = texels_as_floats(image_of<float, 4>(gpu::Format::rg32_float, {1.5f, 2.5f, -3.5f, 4.5f}));
  ASSERT_TRUE(pairs.ok());
  EXPECT_EQ(*pairs, (std::vector<float>{1.5f, 2.5f, 0.0f, 0.0f, -3.5f, 4.5f, 0.0f, 0.0f}));
  EXPECT_FALSE(texels_as_floats(image_of<std::uint32_t, 2>(gpu::Format::rgb10a2_unorm, {0, 0})).ok());
}

class ViewValues : public testing::Test {
 protected:
  static constexpr std::uint32_t kWidth = 96, kHeight = 54;
  void SetUp() override {
    const auto& device = shared_test_device();
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }
  /// The values of a view of the first frame of a scene.
  [[nodiscard]] LinearPicture values(const std::string& scene, const std::string& shown) {
    Options options;
    options.scene = scene;
    options.width = kWidth;
    options.height = kHeight;
    options.view = shown;
    auto opened = open_session_on(shared_test_device(), options, gpu_log());
    if (!opened) {
      ADD_FAILURE() << opened.error().message;
      return {};
    }
    session_ = std::move(opened).value();
    const ViewSettings view = session_->view_settings(kWidth, kHeight, shown);
    const auto frame = session_->render_frame({.settings = view, .target = {}});
    EXPECT_TRUE(frame.ok());
    auto read = read_view_values(*session_, view);
    EXPECT_TRUE(read.ok()) << read.error().message;
    return read.ok() ? std::move(*read) : LinearPicture{};
  }
  /// The line of --pick that begins like this, for a pixel of the last view; empty if there is none.
  [[nodiscard]] std::string picked(std::uint32_t x, std::uint32_t y, const std::string& begin) {
    const auto lines = session_->renderer->pick(session_->world, ViewId{}, x, y);
    if (lines.ok())
      for (const std::string& line : *lines)
        if (line.starts_with(begin)) return line.substr(begin.size());
    return {};
  }
  static vec3 at(const LinearPicture& picture, std::uint32_t x, std::uint32_t y) {
    const float* texel = &picture.rgba[(std::size_t{y} * kWidth + x) * 4];
    return {texel[0], texel[1], texel[2]};
  }
  std::unique_ptr<Session> session_;
};

TEST_F(ViewValues, depth_is_in_metres) {
  const LinearPicture depth = values("builtin:plain", "depth");
  ASSERT_EQ(depth.rgba.size(), std::size_t{kWidth} * kHeight * 4);
  const std::string picked_depth = picked(kWidth / 2, kHeight / 2, "view depth ");
  ASSERT_FALSE(picked_depth.empty());
  EXPECT_NEAR(at(depth, kWidth / 2, kHeight / 2).x, std::stof(picked_depth), 1e-3f);
}

TEST_F(ViewValues, normals_have_unit_length) {
  const LinearPicture normals = values("builtin:plain", "normal");
  int surfaces = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float length = glm::length(at(normals, x, y));
      if (length == 0.0f) continue;  // sky
      ++surfaces;
      EXPECT_NEAR(length, 1.0f, 1e-3f);
    }
  EXPECT_GT(surfaces, 100);
}

TEST_F(ViewValues, a_circle_of_confusion_is_a_signed_radius) {
  const LinearPicture radii = values("builtin:lens", "dof_coc");
  float least = 0.0f, most = 0.0f;
  for (std::size_t i = 0; i < radii.rgba.size(); i += 4) {
    least = std::min(least, radii.rgba[i]);
    most = std::max(most, radii.rgba[i]);
  }
  EXPECT_LT(least, -0.3f);
  EXPECT_GT(most, 0.3f);
}

TEST_F(ViewValues, the_visibility_of_a_light_is_a_share) {
  const LinearPicture visibility = values("builtin:lens", "shadow:key");
  float most = 0.0f;
  for (std::size_t i = 0; i < visibility.rgba.size(); i += 4) most = std::max(most, visibility.rgba[i]);
  EXPECT_EQ(most, 1.0f);
}

TEST_F(ViewValues, counts_are_numbers) {
  const LinearPicture lights = values("builtin:lanterns", "lights_accurate");
  std::uint32_t most = 0;
  for (std::uint32_t y = 4; y < kHeight; y += 8)
    for (std::uint32_t x = 4; x < kWidth; x += 8) {
      const std::string counted = picked(x, y, "accurate search: ");
      if (counted.empty()) continue;
      const auto number = static_cast<std::uint32_t>(std::stoul(counted));
      EXPECT_EQ(at(lights, x, y).x, static_cast<float>(number)) << x << ", " << y;
      most = std::max(most, number);
    }
  EXPECT_GT(most, 3u);
  for (const char* view : {"tile_masks", "lights_final", "visibility_slots"}) {
    const LinearPicture counts = values("builtin:lanterns", view);
    float greatest = 0.0f;
    for (std::size_t i = 0; i < counts.rgba.size(); i += 4) {
      EXPECT_EQ(counts.rgba[i], std::round(counts.rgba[i])) << view;
      greatest = std::max(greatest, counts.rgba[i]);
    }
    EXPECT_GT(greatest, 1.0f) << view;
  }
}

TEST_F(ViewValues, the_lit_picture_is_light) {
  const LinearPicture light = values("builtin:plain", "none");
  float most = 0.0f;
  for (const float value : light.rgba) most = std::max(most, value);
  EXPECT_GT(most, 0.1f);
}

}  // namespace
}  // namespace gloam::test
