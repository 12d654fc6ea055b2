// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gloam {

/// One event of an input script. The events stand for those of the window system.
struct ScriptEvent {
  enum class Kind : std::uint8_t {
    wait,      ///< x: frames
    pace,      ///< x: seconds that each frame counts for the camera from now on, in place of its time on the wall
    key,       ///< text: a key that is pressed and released
    hold,      ///< text: a key that is pressed and stays down
    release,   ///< text: a key
    move,      ///< the pointer to x, y in pixels
    press,     ///< the left button goes down
    lift,      ///< and up
    grab,      ///< the right button goes down
    let_go,    ///< and up
    widget,    ///< the pointer to the middle of the panel's widget of this name
    scroll,    ///< y: steps
    type,      ///< text: typed characters, ASCII
    resize,    ///< the window to x, y pixels
    minimise,  ///< as if the window had no size
    restore,
    pad,    ///< text: an axis or bumper of a gamepad (Gamepad), x: its value from now on
    drop,   ///< text: path of a file that is dropped onto the window
    say,    ///< creates the file `text`: tells a test how far the script is
    until,  ///< waits until the file `text` exists
    close,  ///< the user closes the window
  };
  Kind kind = Kind::wait;
  std::string text = {};
  double x = 0.0;
  double y = 0.0;
};

/// Input events for tests of a whole window (the hidden option `play --script FILE`). One event a line, written as the
/// name of its kind and its arguments; `click X Y` and `click_widget NAME` stand for a movement, a press and a lift.
/// Empty lines and lines that begin with # are left out. Each event takes one frame.
///
/// Keys are named a…z, 0…9, escape, tab, space, enter, period, left_shift,
/// left_control, f1…f12.
class InputScript {
 public:
  InputScript() = default;
  /// Usage error with `source` and the line for what is no event.
  [[nodiscard]] static Result<InputScript> parse(std::string_view text, std::string_view source);

  /// The event of the next frame; `wait` if there is none. file_exists: whether the file of the event `until`, which is
  /// then repeated, exists. settled: the last frame shows all that the user has changed; other frames do not count for
  /// `wait`.
  template <class Exists>
  [[nodiscard]] ScriptEvent next(const Exists& file_exists, bool settled = true) {
    if (at_ == events_.size()) return {};
    const ScriptEvent& event = events_[at_];
    if (event.kind == ScriptEvent::Kind::wait && !settled) return event;
    if (event.kind == ScriptEvent::Kind::wait && waited_ + 1.0 < event.x) {
      waited_ += 1.0;
      return event;
    }
    if (event.kind == ScriptEvent::Kind::until && !file_exists(event.text)) return event;
    waited_ = 0.0;
    ++at_;
    return event;
  }
  [[nodiscard]] bool ended() const { return at_ == events_.size(); }
  [[nodiscard]] const std::vector<ScriptEvent>& events() const { return events_; }

 private:
  std::vector<ScriptEvent> events_;
  std::size_t at_ = 0;
  double waited_ = 0.0;
};

}  // namespace gloam
