// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace gloam {

struct WindowInput;

/// The parts of a gamepad that the window uses. Axes are −1…1; those of sticks to the right and down; triggers rest at
/// −1.
struct Gamepad {
  float left_x = 0.0f;
  float left_y = 0.0f;
  float right_x = 0.0f;
  float right_y = 0.0f;
  float left_trigger = -1.0f;
  float right_trigger = -1.0f;
  float left_bumper = 0.0f;  ///< 1: pressed
  float right_bumper = 0.0f;

  /// Sets the member of this name. Returns whether there is one.
  bool set(std::string_view name, float value);
};

/// The first gamepad, by GLFW's mapping; none if none is connected or its layout is unknown.
[[nodiscard]] std::optional<Gamepad> read_gamepad();

/// The left stick flies, the right one turns, triggers go up and down, and bumpers are fast.
void add_gamepad(const Gamepad& pad, WindowInput& input);

}  // namespace gloam
