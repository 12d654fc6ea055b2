// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/frame.h"

namespace gloam {
namespace {

bool add_copies(const FrameBuilder& frame, const CloseupView& pair, OverlayPlan& overlay) {
  const auto& subject = frame.world().resource<CloseupSubjects>().subjects[pair.subject_index];
  return overlay.add(pair.light, subject.low, subject.high);
}

OverlayPlan empty_plan(const FrameBuilder& frame) { return OverlayPlan(frame.world(), frame.view().id); }

}  // namespace

bool standard_maps_are_seen(const FrameBuilder& frame, std::optional<bool> complete) {
  return !frame.draws().blended.empty() || !complete.value_or(false);
}

CloseupFrame plan_closeup_frame(const FrameBuilder& frame, std::optional<bool> complete) {
  const CloseupViews& views = frame.world().view_resource<CloseupViews>(frame.view().id);
  CloseupFrame closeups;
  closeups.skipped = views.skipped;
  closeups.copies = standard_maps_are_seen(frame, complete);
  if (!closeups.copies) {
    closeups.pairs = views.pairs;
    return closeups;
  }
  closeups.overlay = empty_plan(frame);
  for (const CloseupView& pair : views.pairs) {
    if (add_copies(frame, pair, closeups.overlay))
      closeups.pairs.push_back(pair);
    else
      ++closeups.skipped;
  }
  return closeups;
}

void add_late_copies(const FrameBuilder& frame, CloseupFrame& closeups) {
  closeups.copies = true;
  closeups.overlay = empty_plan(frame);
  // A pair without room for its copies loses the subject's shadow in the overlay for this one frame.
  for (const CloseupView& pair : closeups.pairs) static_cast<void>(add_copies(frame, pair, closeups.overlay));
}

}  // namespace gloam
