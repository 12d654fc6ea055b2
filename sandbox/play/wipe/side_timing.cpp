// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/exact_timing.h"

namespace gloam {

bool ExactTiming::next(const PictureMoment& now, double frame_s) {
  if (now != now_) {
    now_ = now;
    stood_s_ = 0.0;
    drawn_frames_ = 0;
    return false;
  }
  stood_s_ += frame_s;
  if (!has_) return true;
  return of_ != now_ && stood_s_ >= kStandS;
}

bool ExactTiming::drawn() {
  if (++drawn_frames_ < kFrames) return false;
  drawn_frames_ = 0;
  of_ = now_;
  has_ = true;
  return true;
}

}  // namespace gloam
