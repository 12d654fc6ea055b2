// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/window/input_script.h"
#include "sandbox/window/panel_input.h"

namespace gloam {

/// Input of one frame: keyboard, mouse and the first gamepad.
struct WindowInput {
  double forward = 0.0;  ///< W, S, left stick
  double right = 0.0;    ///< D, A, left stick
  double up = 0.0;       ///< E, Q, triggers
  double turn = 0.0;     ///< right stick, −1…1 to the left
  double tilt = 0.0;     ///< right stick, upwards
  double drag_x = 0.0;   ///< pixels that the mouse moved to the right with the left button held
  double drag_y = 0.0;   ///< downwards
  double orbit_x = 0.0;  ///< as drag_x, with the right button
  double orbit_y = 0.0;
  double wheel = 0.0;       ///< steps, positive away from the user
  double pointer_x = -1.0;  ///< pixels from the picture's upper left corner
  double pointer_y = -1.0;
  bool fast = false;                 ///< shift, a shoulder button of the gamepad
  bool leave = false;                ///< Escape was pressed
  bool toggle_panel = false;         ///< Tab or F1 was pressed
  bool pause = false;                ///< Space or P was pressed
  bool step = false;                 ///< . was pressed
  bool screenshot = false;           ///< F12 was pressed
  bool full_screen = false;          ///< F11 was pressed
  bool clicked = false;              ///< the left button went down and up again without a movement
  bool grabbed = false;              ///< the right button went down
  bool look_at = false;              ///< F was pressed
  std::uint32_t camera = 0;          ///< 1…9: number key that was pressed; 0: none
  std::vector<std::string> dropped;  ///< paths of files that were dropped onto the window
  PanelInput panel;                  ///< the same input in the form that a panel takes
};

/// A desktop window for Vulkan. Use it on the main thread only; at most one window may exist at a time.
class Window {
 public:
  /// Returns ErrorKind::failed if there is no display or the window cannot be opened, ErrorKind::no_device if there is
  /// no Vulkan for windows.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const std::string& title, std::uint32_t width,
                                                            std::uint32_t height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Instance extensions that Vulkan needs for a surface.
  [[nodiscard]] std::vector<std::string> vulkan_extensions() const;
  /// The function for gpu::create_swapchain: takes a VkInstance and returns a VkSurfaceKHR as an integer, 0 on failure.
  /// The window must outlive the surface and the function.
  [[nodiscard]] std::function<std::uint64_t(void* instance)> surface_maker() const;

  /// Handles events and returns the input since the last call. While the window is minimised, waits up to 0.1 s for an
  /// event instead of spinning.
  [[nodiscard]] WindowInput poll();
  /// Handles events while this thread waits for other work; poll() returns their input later. Returns whether F11 was
  /// pressed, which poll() then leaves out.
  bool pump();
  /// Waits until an event arrives, this long at most; poll() returns its input later.
  void wait(double seconds);
  /// Whether the user closed the window.
  [[nodiscard]] bool should_close() const;
  /// Size in pixels; 0 × 0 while minimised.
  [[nodiscard]] std::uint32_t width() const;
  [[nodiscard]] std::uint32_t height() const;
  /// Size in desktop units, as for resize(); 0 × 0 while minimised.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> desktop_size() const;
  /// The desktop's scale factor for text; 1 if unknown.
  [[nodiscard]] double content_scale() const;
  void resize(std::uint32_t width, std::uint32_t height);
  /// Changes between a window and the whole screen.
  void toggle_full_screen();
  [[nodiscard]] bool is_full_screen() const;
  void set_title(const std::string& title);
  /// Puts a text on the clipboard.
  void copy(const std::string& text);
  /// Adds an event to those of the next poll(). Nothing for `widget`, `say` and `until`.
  void inject(const ScriptEvent& event);
  /// Takes the window from the screen, before work that ends after it was closed.
  void hide();

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace gloam
