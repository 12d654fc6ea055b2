// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sandbox/play/display/picture_moment.h"

namespace gloam {

/// Decides in which frames the right side of a wipe is drawn. A picture takes kFrames frames, so that effects which
/// accumulate over frames settle.
///
/// At rest: for sides that take long. The first picture is drawn as soon as the moment is that of the last frame; after
/// that, when the moment has changed and has then been the same for kStandS. Always: in each frame, until the moment
/// has been the same for kFrames of them.
class SideTiming {
 public:
  static constexpr double kStandS = 0.5;
  static constexpr std::uint32_t kFrames = 3;
  enum class Pace : std::uint8_t { at_rest, always };

  explicit SideTiming(Pace pace = Pace::at_rest) : pace_(pace) {}

  /// Before each frame. frame_s: since the last frame. Returns whether this frame draws the side.
  [[nodiscard]] bool next(const PictureMoment& now, double frame_s);
  /// True before the first of the frames that draw a picture: contents kept from older frames are of no use.
  [[nodiscard]] bool begins() const { return drawn_frames_ == 0 && !(pace_ == Pace::always && has_); }
  /// After a frame that has drawn it. Returns whether the picture is to be shown: complete, or at the pace `always`.
  bool drawn();
  /// There is a picture to show.
  [[nodiscard]] bool has_picture() const { return has_; }
  /// The shown picture is of the moment of the last frame.
  [[nodiscard]] bool is_present() const { return has_ && of_ == now_; }

 private:
  Pace pace_;
  PictureMoment now_;
  PictureMoment of_;  ///< of the shown picture
  bool has_ = false;
  double stood_s_ = 0.0;  ///< since now_ is the moment
  std::uint32_t drawn_frames_ = 0;
};

}  // namespace gloam
