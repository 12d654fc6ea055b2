// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/variant.h"

#include "sandbox/bench/shadows/phases.h"

namespace gloam {
namespace {

constexpr int kMostFrames = 10;

}  // namespace

Result<FrameSample> draw_settled(ShadowCase& shadows, const ShadowVariant& variant) {
  GLOAM_TRY(shadows.set("shadows.mode", variant.mode));
  GLOAM_TRY(shadows.set("shadows.classify", variant.classify));
  GLOAM_TRY(shadows.set("closeups.max_pairs", variant.closeups));
  for (int i = 0; i < kMostFrames; ++i) {
    auto sample = shadows.draw();
    if (!sample || (i > 0 && lists_had_room(sample->report))) return sample;
  }
  return Error{ErrorKind::failed, "tiles find no room for their lights, however often a frame is drawn"};
}

}  // namespace gloam
