// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/refinement.h"

#include <algorithm>

namespace gloam {

Refinement::Next Refinement::next(const PictureMoment& now, double frame_s, bool active, std::uint32_t frames) {
  if (now != moment_) {
    moment_ = now;
    restart();
    return now_;
  }
  rested_s_ = active ? 0.0 : rested_s_ + frame_s;
  if (full_frames_ >= std::max(kFullFrames, frames))
    now_ = Next::kept;
  else if (rested_s_ >= kRestS)
    now_ = Next::full;
  else
    now_ = refined() ? Next::kept : Next::reduced;
  return now_;
}

void Refinement::restart() {
  now_ = Next::reduced;
  rested_s_ = 0.0;
  full_frames_ = 0;
}

}  // namespace gloam
