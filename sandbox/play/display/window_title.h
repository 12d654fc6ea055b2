// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "sandbox/window/window.h"

namespace gloam {

/// The window's title. It is set only when it changes, because that is a message to the desktop.
class WindowTitle {
 public:
  explicit WindowTitle(Window& window) : window_(window) {}

  /// The title between frames. A text of say() stays until this one changes.
  void rest(const std::string& text) {
    if (std::exchange(rest_, text) != text || busy_) set(text);
    busy_ = false;
  }
  /// The title while a frame takes long, until the next call of rest().
  void busy(const std::string& text) {
    set(text);
    busy_ = true;
  }
  /// Tells the user about something that was done.
  void say(const std::string& text) {
    set(text);
    busy_ = false;
  }

 private:
  void set(const std::string& text) {
    if (std::exchange(shown_, text) != text) window_.set_title(text);
  }

  Window& window_;
  std::string rest_;
  std::string shown_;
  bool busy_ = false;
};

}  // namespace gloam
