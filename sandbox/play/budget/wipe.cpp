// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/wipe.h"

#include <algorithm>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/depth_of_field/components.h"
#include "modules/lights/components.h"
#include "sandbox/play/budget/budget_controls.h"
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
  if (!on_ || !timing_.next(moment(view, time_s), frame_s)) return std::optional<ViewRequest>();
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

PictureMoment Wipe::moment(const ViewSettings& view, double time_s) const {
  const World& world = session_.world;
  ViewSettings seen = view;
  if (seen.follow_camera) follow_camera(world, seen);
  const auto& environment = world.resource<SceneEnvironment>();
  PictureMoment moment = {.numbers = {time_s, static_cast<double>(view.width), static_cast<double>(view.height),
                                      view.heat_range, seen.camera.fov_y, seen.camera.half_height_m,
                                      environment.has_exposure ? 1.0 : 0.0, environment.exposure_ev100},
                          .visualizer = view.visualizer};
  std::vector<double>& numbers = moment.numbers;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) numbers.push_back(seen.world_from_camera[column][row]);
  if (const auto* lens = world.try_get<DepthOfField>(session_.camera)) {
    numbers.push_back(lens->focus_m);
    numbers.push_back(lens->f_number);
  }
  world.view<const Light>().each([&](const Light& light) { numbers.push_back(light.intensity); });
  const std::vector<BudgetState> budgets = session_.renderer->budgets();
  const KnobRegistry& knobs = session_.renderer->knobs();
  for (const Knob& knob : knobs.knobs()) {
    const bool governed = std::ranges::any_of(budgets, [&](const BudgetState& budget) {
      return std::ranges::find(budget.governed, knob.name) != budget.governed.end();
    });
    if (!governed) numbers.push_back(knobs.number(knob));
  }
  return moment;
}

}  // namespace gloam
