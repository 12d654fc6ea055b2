// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/refinement.h"

namespace gloam {

Refinement::Next Refinement::next(const PictureMoment& now, double frame_s, bool active) {
  if (now != moment_) {
    moment_ = now;
    restart();
    return Next::reduced;
  }
  rested_s_ = active ? 0.0 : rested_s_ + frame_s;
  if (full_frames_ == kFullFrames) return Next::kept;
  if (rested_s_ >= kRestS) return Next::full;
  return refined() ? Next::kept : Next::reduced;
}

void Refinement::restart() {
  rested_s_ = 0.0;
  full_frames_ = 0;
}

}  // namespace gloam
