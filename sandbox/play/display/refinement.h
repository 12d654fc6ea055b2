// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sandbox/play/display/picture_moment.h"

namespace gloam {

/// Decides when a picture that is drawn at a reduced scale is refined to the window's size: when its moment has been
/// the same and the user has done nothing for kRestS. kFullFrames frames or more are then drawn at full size, so that
/// effects which accumulate over frames settle, and the last one is kept until the moment changes. While the user moves
/// the pointer, for example over the panel, the kept picture is shown and no frame is drawn, so that the panel answers
/// at once.
class Refinement {
 public:
  static constexpr double kRestS = 0.25;
  static constexpr std::uint32_t kFullFrames = 8;

  enum class Next : std::uint8_t {
    reduced,  ///< draw at the reduced scale
    full,     ///< draw at the window's size
    kept,     ///< show the last full picture again
  };
  /// Before each frame. frame_s: since the last frame. active: the user has done something since then. frames: that the
  /// picture takes until it is complete (Renderer::frames_to_rest).
  Next next(const PictureMoment& now, double frame_s, bool active, std::uint32_t frames = 0);
  /// What next() has said for this frame; reduced after a restart.
  [[nodiscard]] Next now() const { return now_; }
  /// A frame of Next::full was shown.
  void shown_full() { ++full_frames_; }
  /// Draws at the reduced scale until the picture has rested again: the window's size has changed, or the kept picture
  /// is lost.
  void restart();
  /// The window shows a picture of full size.
  [[nodiscard]] bool refined() const { return full_frames_ > 0; }

 private:
  Next now_ = Next::reduced;
  PictureMoment moment_;
  double rested_s_ = 0.0;  ///< since the moment changed or the user was active
  std::uint32_t full_frames_ = 0;
};

}  // namespace gloam
