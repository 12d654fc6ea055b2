// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/wipe.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/play/budget/budget_controls.h"
#include "sandbox/play/display/picture_moment.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

constexpr ViewId kRightView{1};
/// Frames after one that has drawn the right side, whose times may still contain it.
constexpr std::uint32_t kFramesUnderWay = gpu::Device::kFramesInFlight + 1;

/// Those of `values` that the knobs do not have now.
std::vector<KnobOverride> changes(const KnobRegistry& knobs, const std::vector<KnobOverride>& values) {
  std::vector<KnobOverride> found;
  for (const KnobOverride& value : values)
    if (const Knob* knob = knobs.find(value.name); knob != nullptr && knobs.text(*knob) != value.value)
      found.push_back(value);
  return found;
}

bool shows_other_side(const PanelWipe& a, const PanelWipe& b) {
  const auto same = [](const KnobOverride& x, const KnobOverride& y) { return x.name == y.name && x.value == y.value; };
  return a.side != b.side || a.visualizer != b.visualizer || !std::ranges::equal(a.kept, b.kept, same);
}

}  // namespace

void Wipe::set(const PanelWipe& wanted) {
  const bool was_on = wanted_.on, other = shows_other_side(wanted, wanted_);
  wanted_ = wanted;
  if (was_on == wanted.on && !other) return;
  timing_ = SideTiming(wanted.side == WipeSide::exact ? SideTiming::Pace::at_rest : SideTiming::Pace::always);
  if (wanted.on || !was_on) return;
  session_.renderer->release_view(session_.world, kRightView);
  picture_.release();
  unjudged_ = kFramesUnderWay;
}

PanelWipe Wipe::shown() const {
  PanelWipe wipe = wanted_;
  if (!wipe.on) return wipe;
  const std::string side = right_side(wipe);
  if (!timing_.has_picture())
    wipe.note = side + ": the picture is being drawn";
  else if (wipe.side != WipeSide::exact)
    wipe.note = "now | " + side + ": two pictures are drawn in each frame in which something changes";
  else if (!timing_.is_present())
    wipe.note = "exact: of an earlier moment; drawn again when camera and scene have stood still for half a second";
  return wipe;
}

ViewSettings Wipe::right_of(const ViewSettings& view) const {
  ViewSettings right = view;
  right.id = kRightView;
  // A cut of the picture now is one here, too.
  right.camera_cut = view.camera_cut || timing_.begins();
  if (wanted_.side == WipeSide::exact) right.knobs = exact_settings(session_.renderer->budgets());
  if (wanted_.side == WipeSide::picture) right.visualizer = "none";
  if (wanted_.side == WipeSide::view)  // knobs may have changed since it was shown
    right.visualizer =
        session_.renderer->check_visualizer(session_.world, wanted_.visualizer) ? wanted_.visualizer : "none";
  if (wanted_.side != WipeSide::kept_a && wanted_.side != WipeSide::kept_b) return right;
  right.knobs = changes(session_.renderer->knobs(), wanted_.kept);
  // A view that needs another value of a knob than the kept one does not exist with the kept settings.
  const std::string stem = view.visualizer.substr(0, view.visualizer.find(':'));
  for (const VisualizerInfo& info : session_.renderer->visualizers())
    if (info.name == stem && std::ranges::find(right.knobs, info.knob, &KnobOverride::name) != right.knobs.end())
      right.visualizer = "none";
  return right;
}

Result<std::optional<ViewRequest>> Wipe::due(const ViewSettings& view, double time_s, double scale, double frame_s) {
  if (!wanted_.on || !timing_.next(picture_moment(session_, view, time_s), frame_s))
    return std::optional<ViewRequest>();
  const ViewSettings right = right_of(view);
  const auto own = std::ranges::find(right.knobs, kViewScale.name, &KnobOverride::name);
  if (own != right.knobs.end() && wanted_.side == WipeSide::exact) {
    KnobRegistry values = session_.renderer->knobs();
    GLOAM_TRY(values.set(own->name, own->value));
    scale = view_scale(values);
  }
  auto request = picture_.request(right, scale);
  if (!request.ok()) return request.error();
  return std::optional(std::move(request).value());
}

void Wipe::drawn() {
  unjudged_ = kFramesUnderWay;
  if (session_.renderer->report().pipelines_pending > 0) return;
  if (timing_.drawn()) picture_.show_drawn();
}

Status Wipe::add_pass(FrameGraph& graph, ImageRef& window) {
  return wanted_.on && timing_.has_picture() ? picture_.add_pass(graph, window, wanted_.at) : Status();
}

bool Wipe::judges_frame() {
  if (unjudged_ == 0) return true;
  --unjudged_;
  return false;
}

}  // namespace gloam
