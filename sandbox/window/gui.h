// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sandbox/window/panel_input.h"

struct ImDrawData;
struct ImGuiContext;

namespace gloam {

/// The picture that a panel is drawn over.
struct PanelFrame {
  std::uint32_t width = 0;  ///< pixels, > 0
  std::uint32_t height = 0;
  double dt_s = 0.0;  ///< since the last frame
};

/// The font's texture: one coverage byte per texel, row by row from the top.
struct FontTexels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::byte> bytes;
};

/// A context of Dear ImGui with the program's style and font. ImGui's current context is global, and every call sets
/// it, so all of them must be used on one thread.
class Gui {
 public:
  /// scale: factor on the size of text and widgets; 1 for a standard display.
  explicit Gui(double scale = 1.0);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Begins a frame: ImGui's widgets are called between begin() and end().
  void begin(const PanelInput& input, const PanelFrame& frame);
  void end();

  /// Factor on sizes in pixels.
  [[nodiscard]] float scale() const { return scale_; }
  /// Whether a widget used the mouse or keyboard input of the last frame, so that nothing else may use it.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keyboard() const;
  /// A list is open, or a widget is being dragged.
  [[nodiscard]] bool is_busy() const;
  /// Draw data of the last frame, valid until the next. There must have been one.
  [[nodiscard]] const ImDrawData& draw_data() const;
  /// Valid as long as the context.
  [[nodiscard]] FontTexels font() const;

 private:
  ImGuiContext* context_ = nullptr;
  float scale_ = 1.0f;
};

/// Ends a list that BeginCombo() has opened. Escape closes it.
void end_list();

}  // namespace gloam
