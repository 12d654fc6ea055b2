// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/core/result.h"
#include "engine/render/view.h"
#include "sandbox/play/wipe/side_picture.h"
#include "sandbox/play/wipe/side_timing.h"
#include "sandbox/session/session.h"
#include "sandbox/window/panel_wipe.h"

namespace gloam {

/// The right side of a wipe: the picture of the same moment with other settings or without the view. It is drawn in
/// frames of the picture now, as a view with an id, histories and knobs of its own, so nothing of the picture now
/// changes; the scene is posed once for both. Knobs that act on the whole scene, such as the number of grass blades,
/// are those of the left side.
class Wipe {
 public:
  /// The session must outlive it.
  explicit Wipe(Session& session) : session_(session), picture_(*session.device) {}

  /// Turning it off frees all that it has drawn. The note does not count.
  void set(const PanelWipe& wanted);
  [[nodiscard]] PanelWipe shown() const;
  [[nodiscard]] bool on() const { return wanted_.on; }

  /// The view to draw before the picture now in the next frame, if the right side is due. view: the picture now, of the
  /// window's size. time_s: simulated, or any constant if the time changes nothing in the scene. scale: as of
  /// SidePicture, unless settings of the right side choose it. frame_s: since the last frame.
  [[nodiscard]] Result<std::optional<ViewRequest>> due(const ViewSettings& view, double time_s, double scale,
                                                       double frame_s);
  /// The frame with the view of due() was drawn. It does not count if pipelines are still missing: effects may have
  /// been left out.
  void drawn();
  /// Draws the right side over the window's picture. Adds nothing while the wipe is off or has no picture.
  [[nodiscard]] Status add_pass(FrameGraph& graph, ImageRef& window);

  /// Call it once a frame. Whether the time of the last frame says something about the picture now: it did not draw the
  /// other one, nor did a frame that the GPU may still have drawn meanwhile.
  [[nodiscard]] bool judges_frame();

 private:
  /// The settings of the right side's view.
  [[nodiscard]] ViewSettings right_of(const ViewSettings& view) const;

  Session& session_;
  SidePicture picture_;
  SideTiming timing_;
  PanelWipe wanted_;
  std::uint32_t unjudged_ = 0;  ///< frames to come
};

}  // namespace gloam
