// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sandbox/play/display/picture_moment.h"

namespace gloam {

/// Decides in which frames the exact picture of a wipe is drawn. It takes kFrames frames, so that effects which
/// accumulate over frames settle. The first picture is drawn as soon as the moment is that of the last frame; after
/// that, when the moment has changed and has then been the same for kStandS.
class ExactTiming {
 public:
  static constexpr double kStandS = 0.5;
  static constexpr std::uint32_t kFrames = 3;

  /// Before each frame. frame_s: since the last frame. Returns whether this frame draws the exact picture.
  [[nodiscard]] bool next(const PictureMoment& now, double frame_s);
  /// True before the first of the frames that draw a picture: contents kept from older frames are of no use.
  [[nodiscard]] bool begins() const { return drawn_frames_ == 0; }
  /// After a frame that has drawn it. Returns whether the picture is complete.
  bool drawn();
  /// A picture is complete.
  [[nodiscard]] bool has_picture() const { return has_; }
  /// The complete picture is of the moment of the last frame.
  [[nodiscard]] bool is_present() const { return has_ && of_ == now_; }

 private:
  PictureMoment now_;
  PictureMoment of_;  ///< of the complete picture
  bool has_ = false;
  double stood_s_ = 0.0;  ///< since now_ is the moment
  std::uint32_t drawn_frames_ = 0;
};

}  // namespace gloam
