// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/window/panel_input.h"

namespace gloam {

/// Keyboard and mouse input of one frame.
struct WindowInput {
  double forward = 0.0;       ///< W, S
  double right = 0.0;         ///< D, A
  double up = 0.0;            ///< E, Q
  double drag_x = 0.0;        ///< pixels that the mouse moved to the right with a button held
  double drag_y = 0.0;        ///< downwards
  bool fast = false;          ///< shift
  bool leave = false;         ///< Escape was pressed
  bool toggle_panel = false;  ///< Tab or F1 was pressed
  PanelInput panel;           ///< the same input in the form that a panel takes
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
  /// Whether the user closed the window.
  [[nodiscard]] bool should_close() const;
  /// Size in pixels; 0 × 0 while minimised.
  [[nodiscard]] std::uint32_t width() const;
  [[nodiscard]] std::uint32_t height() const;
  /// The desktop's scale factor for text; 1 if unknown.
  [[nodiscard]] double content_scale() const;
  void resize(std::uint32_t width, std::uint32_t height);

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace gloam
