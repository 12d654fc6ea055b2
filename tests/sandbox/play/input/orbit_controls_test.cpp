// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/orbit_controls.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(PixelAt, scales_with_the_picture) {
  ViewSettings view;
  view.width = 640;
  view.height = 360;
  EXPECT_EQ(pixel_at(view, {100.7, 20.0, 1.0}), uvec2(100, 20));
  EXPECT_EQ(pixel_at(view, {100.0, 20.0, 0.25}), uvec2(25, 5));
  EXPECT_EQ(pixel_at(view, {639.9, 359.9, 1.0 / 3.0}), uvec2(212, 119)) << "213 x 120 pixels are drawn";
}

TEST(PixelAt, is_none_outside_the_window) {
  ViewSettings view;
  view.width = 640;
  view.height = 360;
  for (const WindowPlace& place : {WindowPlace{-1.0, 5.0}, {5.0, -0.1}, {640.0, 5.0}, {5.0, 360.0}, {0.0 / 1.0, 1e30}})
    EXPECT_FALSE(pixel_at(view, place)) << place.x << "," << place.y;
}

}  // namespace
}  // namespace gloam
