// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/play_panel.h"

#include <utility>

#include "sandbox/session/frame_tracing.h"

namespace gloam {

PlayPanel::PlayPanel(Session& session, double scale, bool shown)
    : session_(session), scale_(scale), shown_(shown), visualizers_(session.renderer->visualizers()) {}

Status PlayPanel::open() {
  auto panel = std::make_unique<Panel>(scale_);
  auto renderer = PanelRenderer::create(*session_.device, panel->font());
  if (!renderer.ok()) return renderer.error();
  panel_ = std::move(panel);
  renderer_ = std::move(renderer).value();
  return {};
}

Status PlayPanel::update(WindowInput& input, const PanelFrame& frame, ViewSettings& view, ResolutionScale& scale) {
  // Tab does not hide the panel while the user types text.
  if (input.toggle_panel && !(drawn_ && panel_->wants_keyboard())) shown_ = !shown_;
  drawn_ = shown_ && frame.width > 0 && frame.height > 0;
  if (!drawn_) return {};
  if (panel_ == nullptr) GLOAM_TRY(open());

  Renderer& renderer = *session_.renderer;
  const FrameReport report = renderer.report();
  times_.add(frame.dt_s * 1e3, report);
  // Escape ends text input; only the next Escape leaves the program.
  const bool typing = panel_->wants_keyboard();
  const auto show = [&](const std::string& visualizer) -> Status {
    GLOAM_TRY(renderer.check_visualizer(session_.world, visualizer));
    GLOAM_TRY(check_shown_live(renderer, visualizer));
    view.visualizer = visualizer;
    return {};
  };
  panel_->update(input.panel, frame,
                 {.knobs = renderer.knobs(),
                  .times = times_,
                  .modules = report.modules,
                  .visualizers = visualizers_,
                  .visualizer = view.visualizer,
                  .show = show,
                  .scale = scale.scale(),
                  .scale_setting = scale.setting(),
                  .scale_steps = ResolutionScale::kSteps,
                  .set_scale = [&](double setting) { scale.set(setting); }});
  if (panel_->wants_mouse()) {
    input.drag_x = input.drag_y = 0.0;
    input.clicked = false;
  }
  if (typing || panel_->wants_keyboard()) {
    input.forward = input.right = input.up = 0.0;
    input.fast = input.leave = false;
    input.pause = input.step = false;
    input.camera = 0;
  }
  return {};
}

void PlayPanel::set_scale(double scale) {
  if (scale == scale_) return;
  scale_ = scale;
  drawn_ = false;
  renderer_.reset();
  panel_.reset();
}

std::optional<vec2> PlayPanel::widget(std::string_view name) const {
  if (!drawn_) return std::nullopt;
  for (const PanelWidget& widget : panel_->widgets())
    if (widget.name == name) return 0.5f * vec2(widget.left + widget.right, widget.top + widget.bottom);
  return std::nullopt;
}

std::function<Status(FrameGraph&, ImageRef&)> PlayPanel::overlay() {
  if (!drawn_) return {};
  return
      [this](FrameGraph& graph, ImageRef& picture) { return renderer_->add_pass(graph, picture, panel_->draw_data()); };
}

}  // namespace gloam
