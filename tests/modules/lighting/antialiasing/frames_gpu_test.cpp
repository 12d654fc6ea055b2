// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/math/srgb.h"
#include "tests/modules/lighting/antialiasing/antialiased_frame.h"

namespace gloam {
namespace {

using test::AntialiasedFrame;

TEST_F(AntialiasedFrame, has_passes_only_if_the_knob_is_on) {
  glow(0.2);
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(antialiasing_passes(), 0u) << "off is the default";
  static_cast<void>(drawn("smaa"));
  EXPECT_EQ(antialiasing_passes(), 3u);
  settings.visualizer = "albedo";
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(antialiasing_passes(), 0u) << "a view is drawn over the picture as it is";
  settings.visualizer = "none";
  settings.purpose = ViewPurpose::reference;
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(antialiasing_passes(), 0u) << "a reference is never blurred";
}

TEST_F(AntialiasedFrame, is_nearer_to_the_supersampled_picture) {
  glow(0.21);
  for (const bool orthographic : {true, false}) {
    settings.camera.orthographic = orthographic;
    const Picture right = supersampled(16);
    const Picture plain = drawn("off"), smooth = drawn("smaa");
    EXPECT_GT(root_mean_square(plain, right), 5.0);
    EXPECT_LT(root_mean_square(smooth, right), 0.5 * root_mean_square(plain, right)) << orthographic;
  }
}

TEST_F(AntialiasedFrame, leaves_upright_squares_as_they_are) {
  glow(0.0);
  for (const char* dither : {"off", "on"}) {
    set("lighting.dither", dither);
    const Picture plain = drawn("off"), smooth = drawn("smaa");
    // The light before blending is rounded to half floats, which is less than a twentieth of a step.
    for (std::size_t i = 0; i < plain.rgba.size(); ++i) ASSERT_NEAR(plain.rgba[i], smooth.rgba[i], 1) << dither;
    EXPECT_LT(root_mean_square(plain, smooth), 0.1);
  }
}

TEST_F(AntialiasedFrame, is_the_same_twice_and_in_every_size) {
  glow(0.3);
  for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 2u}, {1u, 33u}, {65u, 3u}, {97u, 61u}}) {
    settings.width = width;
    settings.height = height;
    EXPECT_EQ(drawn("smaa").rgba, drawn("smaa").rgba) << width << "x" << height;
  }
}

TEST_F(AntialiasedFrame, reference_shows_what_share_of_a_pixel_is_covered) {
  // The right edge of the square lies at 0.3 pixels of column 68, its upper edge at 0.6 pixels of row 11.
  glow(0.0, dvec3(0.015, 0.02, 0.0));
  const Picture right = supersampled(64);
  const auto share = [&](std::uint32_t x, std::uint32_t y) {
    const double value = right.rgba[(y * right.width + x) * 4] / 255.0;
    const double inside = right.rgba[(32 * right.width + 48) * 4] / 255.0;
    return srgb_to_linear(value) / srgb_to_linear(inside);
  };
  EXPECT_NEAR(share(67, 32), 1.0, 0.01);
  EXPECT_NEAR(share(68, 32), 0.3, 0.04);
  EXPECT_NEAR(share(69, 32), 0.0, 0.01);
  EXPECT_NEAR(share(48, 12), 1.0, 0.01);
  EXPECT_NEAR(share(48, 11), 0.4, 0.04);
  EXPECT_NEAR(share(48, 10), 0.0, 0.01);
}

}  // namespace
}  // namespace gloam
