// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/wipe_line.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

/// A pointer over a picture of 200 pixels with a line at 0.5, which it grabs from 6 pixels.
struct Pointer {
  WipeLine line;
  float at = 0.5f;
  bool move(double x, bool down, bool free = true) {
    WindowInput input;
    input.pointer_x = x;
    input.panel.buttons[0] = down;
    return line.steer(at, input, 200, free, 6.0);
  }
};

TEST(WipeLine, follows_the_pointer_that_grabs_it_and_stays_in_the_picture) {
  Pointer pointer;
  EXPECT_FALSE(pointer.move(104.0, false));
  EXPECT_TRUE(pointer.move(104.0, true));
  EXPECT_FLOAT_EQ(pointer.at, 0.52f);
  EXPECT_TRUE(pointer.move(150.0, true)) << "far from where it was";
  EXPECT_FLOAT_EQ(pointer.at, 0.75f);
  EXPECT_TRUE(pointer.move(900.0, true));
  EXPECT_FLOAT_EQ(pointer.at, 1.0f);
  EXPECT_TRUE(pointer.move(-5.0, true));
  EXPECT_FLOAT_EQ(pointer.at, 0.0f);
  EXPECT_TRUE(pointer.move(20.0, false)) << "the end of a drag is no click";
  EXPECT_FALSE(pointer.move(20.0, false));
  EXPECT_FLOAT_EQ(pointer.at, 0.0f) << "at the edge it can be grabbed again";
  EXPECT_TRUE(pointer.move(3.0, true));
}

TEST(WipeLine, leaves_other_drags_alone) {
  Pointer pointer;
  EXPECT_FALSE(pointer.move(120.0, true)) << "beside the line";
  EXPECT_FALSE(pointer.move(100.0, true)) << "a drag that passes over it";
  EXPECT_FALSE(pointer.move(100.0, false));
  EXPECT_FALSE(pointer.move(100.0, true, false)) << "the panel is over it";
  EXPECT_FALSE(pointer.move(-1.0, false)) << "the pointer is outside the window";
  EXPECT_FLOAT_EQ(pointer.at, 0.5f);
}

}  // namespace
}  // namespace gloam
