// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/gamepad.h"

#include <gtest/gtest.h>

#include "sandbox/window/window.h"

namespace gloam {
namespace {

WindowInput input_of(const Gamepad& pad) {
  WindowInput input;
  add_gamepad(pad, input);
  return input;
}

TEST(Gamepad, at_rest_moves_nothing_even_if_its_sticks_are_a_little_off) {
  for (const float off : {0.0f, 0.1f, -0.14f}) {
    const WindowInput input = input_of({.left_x = off, .left_y = off, .right_x = off, .right_y = off});
    EXPECT_EQ(input.right, 0.0);
    EXPECT_EQ(input.forward, 0.0);
    EXPECT_EQ(input.up, 0.0);
    EXPECT_EQ(input.turn, 0.0);
    EXPECT_EQ(input.tilt, 0.0);
    EXPECT_FALSE(input.fast);
  }
}

TEST(Gamepad, sticks_and_triggers_reach_the_whole_range_without_a_jump) {
  EXPECT_DOUBLE_EQ(input_of({.left_x = 1.0f}).right, 1.0);
  EXPECT_DOUBLE_EQ(input_of({.left_y = -1.0f}).forward, 1.0) << "up is forward";
  EXPECT_DOUBLE_EQ(input_of({.right_x = 1.0f}).turn, -1.0) << "turns are positive to the left";
  EXPECT_DOUBLE_EQ(input_of({.right_y = -1.0f}).tilt, 1.0) << "upwards";
  EXPECT_DOUBLE_EQ(input_of({.right_trigger = 1.0f}).up, 1.0);
  EXPECT_DOUBLE_EQ(input_of({.left_trigger = 1.0f}).up, -1.0);
  EXPECT_DOUBLE_EQ(input_of({.left_trigger = 1.0f, .right_trigger = 1.0f}).up, 0.0);
  EXPECT_LT(input_of({.left_x = 0.16f}).right, 0.02) << "it begins at the end of the rest";
  EXPECT_TRUE(input_of({.right_bumper = 1.0f}).fast);
}

TEST(Gamepad, adds_to_the_keys) {
  WindowInput input;
  input.forward = 1.0;
  input.fast = true;
  add_gamepad({.left_y = 1.0f}, input);
  EXPECT_DOUBLE_EQ(input.forward, 0.0);
  EXPECT_TRUE(input.fast);
}

TEST(Gamepad, parts_go_by_their_names) {
  Gamepad pad;
  EXPECT_TRUE(pad.set("right_trigger", 0.5f));
  EXPECT_EQ(pad.right_trigger, 0.5f);
  EXPECT_FALSE(pad.set("trigger", 0.5f));
}

}  // namespace
}  // namespace gloam
