// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/settled_frame.h"

#include <cstdint>

namespace gloam {
namespace {

/// Frames drawn up to the one that is read. Their times go on, so that simulations start again and run with the knobs'
/// values.
constexpr std::int32_t kSettlingFrames = 3;

}  // namespace

Status settle(CostSubject& subject) {
  for (std::int32_t index = 1 - kSettlingFrames; index <= 0; ++index) GLOAM_TRY(subject.draw(index));
  for (std::uint32_t more = subject.frames_to_rest(); more > 0; --more) GLOAM_TRY(subject.draw(0));
  return {};
}

Result<FramePictures> draw_settled(CostSubject& subject) {
  GLOAM_TRY(settle(subject));
  return subject.read();
}

}  // namespace gloam
