// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/wipe.h"

#include <algorithm>

#include "sandbox/play/budget/budget_controls.h"
#include "sandbox/play/display/picture_moment.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

constexpr ViewId kExactView{1};
/// Frames after one that has drawn the exact picture, whose times may still contain it.
constexpr std::uint32_t kFramesUnderWay = gpu::Device::kFramesInFlight + 1;

}  // namespace

void Wipe::set(bool on, float at) {
  at_ = at;
  if (on == on_) return;
  on_ = on;
  timing_ = {};
  if (on) return;
  session_.renderer->release_view(session_.world, kExactView);
  picture_.release();
  unjudged_ = kFramesUnderWay;
}

PanelWipe Wipe::shown() const {
  const char* note = "";
  if (!timing_.has_picture())
    note = "the exact picture is being drawn";
  else if (!timing_.is_present())
    note = "exact of an earlier moment: it is drawn again when camera and scene have stood still for half a second";
  return {.on = on_, .at = at_, .note = on_ ? note : ""};
}

Result<std::optional<ViewRequest>> Wipe::due(const ViewSettings& view, double time_s, double scale, double frame_s) {
  if (!on_ || !timing_.next(picture_moment(session_, view, time_s), frame_s)) return std::optional<ViewRequest>();
  ViewSettings exact = view;
  exact.id = kExactView;
  exact.camera_cut = timing_.begins();
  exact.knobs = exact_settings(session_.renderer->budgets());
  const auto own = std::ranges::find(exact.knobs, kViewScale.name, &KnobOverride::name);
  if (own != exact.knobs.end()) {
    KnobRegistry values = session_.renderer->knobs();
    GLOAM_TRY(values.set(own->name, own->value));
    scale = view_scale(values);
  }
  auto request = picture_.request(exact, scale);
  if (!request.ok()) return request.error();
  return std::optional(std::move(request).value());
}

void Wipe::drawn() {
  unjudged_ = kFramesUnderWay;
  if (timing_.drawn()) picture_.show_drawn();
}

Status Wipe::add_pass(FrameGraph& graph, ImageRef& window) {
  return on_ && timing_.has_picture() ? picture_.add_pass(graph, window, at_) : Status();
}

bool Wipe::judges_frame() {
  if (unjudged_ == 0) return true;
  --unjudged_;
  return false;
}

}  // namespace gloam
