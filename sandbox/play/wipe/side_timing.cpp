// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/side_timing.h"

namespace gloam {

bool SideTiming::next(const PictureMoment& now, double frame_s) {
  if (now != now_) {
    now_ = now;
    stood_s_ = 0.0;
    drawn_frames_ = 0;
    return pace_ == Pace::always;
  }
  stood_s_ += frame_s;
  if (pace_ == Pace::always) return drawn_frames_ < kFrames;
  if (!has_) return true;
  return of_ != now_ && stood_s_ >= kStandS;
}

bool SideTiming::drawn() {
  const bool complete = ++drawn_frames_ >= kFrames;
  if (!complete && pace_ == Pace::at_rest) return false;
  if (pace_ == Pace::at_rest) drawn_frames_ = 0;
  of_ = now_;
  has_ = true;
  return true;
}

}  // namespace gloam
