// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/gamepad.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <utility>

#include "sandbox/window/window.h"

namespace gloam {
namespace {

/// Sticks rest a little off their middle.
double stick(float value) {
  constexpr double kRest = 0.15;
  const double size = std::abs(static_cast<double>(value));
  return size <= kRest ? 0.0 : std::copysign((size - kRest) / (1.0 - kRest), static_cast<double>(value));
}

}  // namespace

bool Gamepad::set(std::string_view name, float value) {
  const std::pair<std::string_view, float*> members[] = {{"left_x", &left_x},
                                                         {"left_y", &left_y},
                                                         {"right_x", &right_x},
                                                         {"right_y", &right_y},
                                                         {"left_trigger", &left_trigger},
                                                         {"right_trigger", &right_trigger},
                                                         {"left_bumper", &left_bumper},
                                                         {"right_bumper", &right_bumper}};
  for (const auto& [known, member] : members) {
    if (known != name) continue;
    *member = value;
    return true;
  }
  return false;
}

std::optional<Gamepad> read_gamepad() {
  GLFWgamepadstate state;
  if (glfwGetGamepadState(GLFW_JOYSTICK_1, &state) == GLFW_FALSE) return std::nullopt;
  const auto button = [&](int index) { return state.buttons[index] == GLFW_PRESS ? 1.0f : 0.0f; };
  return Gamepad{.left_x = state.axes[GLFW_GAMEPAD_AXIS_LEFT_X],
                 .left_y = state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y],
                 .right_x = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X],
                 .right_y = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y],
                 .left_trigger = state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER],
                 .right_trigger = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER],
                 .left_bumper = button(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER),
                 .right_bumper = button(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER)};
}

void add_gamepad(const Gamepad& pad, WindowInput& input) {
  input.right += stick(pad.left_x);
  input.forward -= stick(pad.left_y);
  input.turn -= stick(pad.right_x);
  input.tilt -= stick(pad.right_y);
  input.up += 0.5 * static_cast<double>(pad.right_trigger - pad.left_trigger);
  input.fast |= pad.left_bumper > 0.5f || pad.right_bumper > 0.5f;
}

}  // namespace gloam
