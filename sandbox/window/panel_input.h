// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>

namespace gloam {

/// Keys that edit text or move the cursor in it.
enum class EditKey : std::uint8_t {
  tab,
  left,
  right,
  up,
  down,
  page_up,
  page_down,
  home,
  end,
  insert,
  erase,
  backspace,
  space,
  enter,
  escape,
  keypad_enter,
  a,
  c,
  v,
  x,
  y,
  z,
};
inline constexpr std::size_t kEditKeyCount = 22;

/// Mouse and keyboard input of one frame for a panel. A button or key is set if it is held or was pressed since the
/// last frame, so that a slow frame misses no click.
struct PanelInput {
  double mouse_x = -1.0;  ///< pixels from the picture's upper left corner
  double mouse_y = -1.0;
  std::array<bool, 3> buttons = {};  ///< left, right, middle
  double wheel = 0.0;                ///< steps, positive away from the user
  std::bitset<kEditKeyCount> keys;   ///< indexed by EditKey
  bool control = false;
  bool shift = false;
  bool alt = false;
  std::u32string text;  ///< typed since the last frame
  bool operator==(const PanelInput&) const = default;
};

}  // namespace gloam
