// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/heat_follower.h"

#include "sandbox/session/program_knobs.h"
#include "sandbox/session/results/heat_fit.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFramesBetweenFits = 30;

}  // namespace

Status HeatFollower::choose(Session& session, ViewSettings& view, bool shown) {
  const Renderer& renderer = *session.renderer;
  const KnobRegistry& knobs = session.renderer->knobs();
  if (!fits_heat_range(knobs) || !shows_heat(renderer, view.visualizer)) {
    view.heat_range = heat_range(knobs);
    fitted_view_.clear();
    due_ = false;
    return {};
  }
  if (fitted_view_ != view.visualizer) {
    fitted_view_ = view.visualizer;
    frames_to_fit_ = 1;
    due_ = true;
  } else if (shown && frames_to_fit_-- == 0) {
    frames_to_fit_ = kFramesBetweenFits;
    const auto range = fitting_heat_range(session, view);
    if (!range) return range.error();
    view.heat_range = *range;
    due_ = false;
  }
  return {};
}

}  // namespace gloam
