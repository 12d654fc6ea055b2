// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/render/renderer.h"
#include "sandbox/session/session.h"
#include "sandbox/window/panel.h"
#include "sandbox/window/panel_renderer.h"
#include "sandbox/window/window.h"

namespace gloam {

/// The panel of `play`: in sight or not, and where the session's state meets it. Costs nothing before it is first
/// shown.
class PlayPanel {
 public:
  /// The session must outlive it. scale: size of letters, 1 on a usual display.
  PlayPanel(Session& session, double scale, bool shown);

  /// Before a frame of the window's size in pixels: shows what is known, changes knobs and view, and takes out of the
  /// input what the user meant for the panel.
  [[nodiscard]] Status update(WindowInput& input, const PanelFrame& frame, ViewSettings& view);

  /// For ViewTarget::overlay of the frame after an update; empty while out of sight.
  [[nodiscard]] std::function<Status(FrameGraph&, ImageRef&)> overlay();

 private:
  [[nodiscard]] Status open();

  Session& session_;
  double scale_;
  bool shown_;
  bool drawn_ = false;  ///< by the last update
  FrameTimes times_;
  std::vector<VisualizerInfo> visualizers_;
  std::unique_ptr<Panel> panel_;
  std::unique_ptr<PanelRenderer> renderer_;
};

}  // namespace gloam
