// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// How a frame of the player gets into the window: whole, enlarged, kept, with the other side of a wipe.
#include <array>

#include "engine/render/kept_frames/kept_frames.h"
#include "modules/lighting/outputs.h"
#include "sandbox/play/display/reduced_knobs.h"
#include "sandbox/play/player.h"

namespace gloam {

bool Player::shows_apart() const {
  const KnobRegistry& knobs = session_.renderer->knobs();
  if (knobs.value(kFrameReuse) == FrameReuse::off || knobs.value(kAntialiasing) == Antialiasing::taa) return false;
  // A second frame on the GPU only pays if the first one is kept.
  return !camera_moves_ && !wipe_.on() && !scene_moves(session_);
}

/// The next frame's view: drawn into the window's picture, or at a reduced size and then enlarged into it.
Result<ViewRequest> Player::request() {
  ViewRequest request = {.settings = settings_, .target = {}, .keep_linear = false};
  const double scale = this->scale();
  request.settings.width = scaled_side(settings_.width, scale);
  request.settings.height = scaled_side(settings_.height, scale);
  if (scale != drawn_scale_ && drawn_scale_ != 0.0) session_.renderer->free_idle_memory();
  drawn_scale_ = scale;
  const bool keeps = refinement_.now() == Refinement::Next::full;
  const bool whole = request.settings.width == settings_.width && request.settings.height == settings_.height;
  if (on_software_) request.settings.knobs = knobs_at_scale(session_.renderer->knobs(), scale);
  if (!whole) request.settings.aspect = static_cast<float>(settings_.width) / static_cast<float>(settings_.height);
  // Accumulated pictures are enlarged while they are accumulated, so they keep their history when the scale changes.
  const bool enlarged = session_.renderer->knobs().value(kAntialiasing) == Antialiasing::taa && may_enlarge(request);
  const bool apart = shows_apart();
  if (!keeps && !apart && (whole || enlarged)) {
    upscaler_.release();
    if (!whole) {
      request.target.width = settings_.width;
      request.target.height = settings_.height;
    }
    request.target.after = gpu::Access::present;
    request.target.acquire = [this] { return pictures_.acquire(); };
    request.target.overlay = [this](FrameGraph& graph, ImageRef& window) { return add_overlays(graph, window); };
    return request;
  }
  const auto image = upscaler_.image(request.settings.width, request.settings.height);
  if (!image.ok()) return image.error();
  request.target.image = *image;
  request.target.after = gpu::Access::fragment_read;
  if (apart) {
    request.target.keeps_image = true;
    return request;
  }
  request.target.overlay = [this](FrameGraph& graph, ImageRef& picture) { return show_enlarged(graph, picture); };
  return request;
}

Status Player::show_again() {
  return kept_picture_.draw(pictures_, upscaler_,
                            [this](FrameGraph& graph, ImageRef& window) { return add_overlays(graph, window); });
}

Status Player::show_enlarged(FrameGraph& graph, ImageRef picture) {
  const auto image = pictures_.acquire();
  if (!image.ok()) return image.error();
  if (!*image) return {};
  ImageRef window = graph.import_image("window", *image, gpu::Access::none, gpu::Access::present);
  GLOAM_TRY(upscaler_.add_passes(graph, picture, window));
  return add_overlays(graph, window);
}

Status Player::add_overlays(FrameGraph& graph, ImageRef& window) {
  GLOAM_TRY(wipe_.add_pass(graph, window));
  const auto panel = panel_.overlay();
  return panel ? panel(graph, window) : Status();
}

Status Player::count_shown(bool first) {
  if (options_.frames == 0) return {};
  if (first) GLOAM_TRY(session_.renderer->wait());
  lasting_.figures.add(PlayFigures::Clock::now(), scaled_side(settings_.width, drawn_scale_),
                       scaled_side(settings_.height, drawn_scale_), drawn_scale_);
  return {};
}

/// Waits for the frame only if its times are needed (--stats, --trace). A frame that also draws the right side of
/// the wipe has no sample.
Status Player::render(const ViewRequest& request) {
  const double time_s = wipe_.on() && scene_moves(session_) ? time_s_ : 0.0;
  const auto right = wipe_.due(settings_, time_s, moving_scale(), frame_s_);
  if (!right) return right.error();
  if (*right) {
    GLOAM_TRY(session_.renderer->render(session_.world, std::array{**right, request}));
    wipe_.drawn();
    return {};
  }
  if (options_.stats.empty() && options_.trace.empty()) {
    panel_.add_systems(session_.zones.take());
    return session_.renderer->render(session_.world, {&request, 1});
  }
  auto sample = session_.render_frame(request);
  if (!sample) return sample.error();
  samples_.push_back(std::move(sample).value());
  return {};
}

}  // namespace gloam
