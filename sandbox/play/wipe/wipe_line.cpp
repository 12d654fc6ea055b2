// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/wipe_line.h"

#include <algorithm>
#include <cmath>

namespace gloam {

bool WipeLine::steer(float& at, const WindowInput& input, std::uint32_t width, bool free, double reach) {
  const bool down = input.panel.buttons[0], pressed = down && !was_down_;
  was_down_ = down;
  const bool ends = drags_ && !down;
  if (!down) drags_ = false;
  const double x = input.pointer_x, line = static_cast<double>(at) * width;
  if (pressed && free && x >= 0.0 && std::abs(x - line) <= reach) drags_ = true;
  if (drags_ && width > 0) at = static_cast<float>(std::clamp(x / width, 0.0, 1.0));
  return drags_ || ends;  // the end of a drag is no click on the picture
}

}  // namespace gloam
