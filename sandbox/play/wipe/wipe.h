// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/core/result.h"
#include "sandbox/play/budget/exact_picture.h"
#include "sandbox/play/budget/exact_timing.h"
#include "sandbox/session/session.h"
#include "sandbox/window/panel_budget.h"

namespace gloam {

/// The exact picture of a wipe: every knob that a budget sets has the value of its most exact setting. It is drawn in
/// frames of the picture now, as a view with an id, histories and knobs of its own, so nothing of the picture now
/// changes; the scene is posed once for both.
class Wipe {
 public:
  /// The session must outlive it.
  explicit Wipe(Session& session) : session_(session), picture_(*session.device) {}

  /// at: of PanelWipe. Turning it off frees all that it has drawn.
  void set(bool on, float at);
  [[nodiscard]] PanelWipe shown() const;

  /// The view to draw before the picture now in the next frame, if the exact picture is due. view: the picture now, of
  /// the window's size. scale: as of ExactPicture, for budgets that do not choose it. frame_s: since the last frame.
  [[nodiscard]] Result<std::optional<ViewRequest>> due(const ViewSettings& view, double time_s, double scale,
                                                       double frame_s);
  /// The frame with the view of due() was drawn.
  void drawn();
  /// Draws the exact side over the window's picture. Adds nothing while the wipe is off or has no picture.
  [[nodiscard]] Status add_pass(FrameGraph& graph, ImageRef& window);

  /// Call it once a frame. Whether the time of the last frame says something about the picture now: it did not draw the
  /// exact one, nor did a frame that the GPU may still have drawn meanwhile.
  [[nodiscard]] bool judges_frame();

 private:
  Session& session_;
  ExactPicture picture_;
  ExactTiming timing_;
  bool on_ = false;
  float at_ = 0.5f;
  std::uint32_t unjudged_ = 0;  ///< frames to come
};

}  // namespace gloam
