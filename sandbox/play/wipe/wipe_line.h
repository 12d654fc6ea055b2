// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sandbox/window/window.h"

namespace gloam {

/// Moves the line of a wipe with the pointer.
class WipeLine {
 public:
  /// Call it once a frame. at: PanelWipe::at, which it changes. width: of the window. free: nothing else uses the
  /// pointer. reach: pixels on both sides of the line that grab it. Returns whether it uses the pointer.
  bool steer(float& at, const WindowInput& input, std::uint32_t width, bool free, double reach);

 private:
  bool drags_ = false;
  bool was_down_ = false;
};

}  // namespace gloam
