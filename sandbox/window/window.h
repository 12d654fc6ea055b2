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

/// Keys and mouse of one frame.
struct WindowInput {
  double forward = 0.0;       ///< W, S
  double right = 0.0;         ///< D, A
  double up = 0.0;            ///< E, Q
  double drag_x = 0.0;        ///< pixels the mouse moved with a button held, to the right
  double drag_y = 0.0;        ///< downwards
  bool fast = false;          ///< shift
  bool leave = false;         ///< Escape was struck
  bool toggle_panel = false;  ///< Tab or F1 was struck
  PanelInput panel;           ///< the same mouse and keyboard, as a panel takes them
};

/// A window of the desktop, for Vulkan. One thread (the main one), one window at a time.
class Window {
 public:
  /// ErrorKind::failed in one sentence when there is no display.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const std::string& title, std::uint32_t width,
                                                            std::uint32_t height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Instance extensions that Vulkan needs for a surface.
  [[nodiscard]] std::vector<std::string> vulkan_extensions() const;
  /// From a VkInstance to a VkSurfaceKHR as an integer, 0 when it fails: for gpu::create_swapchain. The window must
  /// outlive its use.
  [[nodiscard]] std::function<std::uint64_t(void* instance)> surface_maker() const;

  /// Takes events and returns what was held and moved since the last call. While minimised it waits for an event
  /// instead of spinning.
  [[nodiscard]] WindowInput poll();
  /// Closed by the user.
  [[nodiscard]] bool should_close() const;
  /// Pixels; 0 by 0 while minimised.
  [[nodiscard]] std::uint32_t width() const;
  [[nodiscard]] std::uint32_t height() const;
  /// How much larger than usual the desktop shows letters; 1 when it does not say.
  [[nodiscard]] double content_scale() const;
  void resize(std::uint32_t width, std::uint32_t height);

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace gloam
