// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "modules/lighting/outputs.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/numbered_path.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/drawing/enlarged.h"
#include "sandbox/session/drawing/frame_run.h"
#include "sandbox/session/drawing/frame_tracing.h"
#include "sandbox/session/drawing/list_room.h"
#include "sandbox/session/drawing/session_budget.h"
#include "sandbox/session/loading/kept_pipelines.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/program_knobs.h"
#include "sandbox/session/results/heat_fit.h"
#include "sandbox/session/results/run_output.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

/// The view as the picture shows it.
struct ShownView {
  ViewSettings view;
  std::optional<VisualizerInfo> traced;  ///< of a visualizer that needs traced data
  bool fit = false;                      ///< the range of its colour scale is to be fitted to the first picture

  /// The view of the frames before settle_view().
  [[nodiscard]] ViewSettings drawn() const {
    ViewSettings drawn = view;
    if (traced) drawn.visualizer = "none";
    return drawn;
  }
};

/// Traces the data that the visualizer needs and draws the last frame again with it. last: replaced by that frame.
Status show_traced_view(Session& session, const CommandContext& context, const VisualizerInfo& info,
                        const ViewSettings& view, FrameSample& last) {
  GLOAM_TRY(trace_for_view(session, info, view, context.console, context.options.quiet));
  auto sample = session.render_frame({.settings = view, .target = {}});
  if (!sample) return sample.error();
  last = std::move(sample).value();
  return {};
}

/// The size of the next frame: that of the picture, times the knob's scale, which a budget may change.
void set_size(const Session& session, const Options& options, ViewSettings& view) {
  set_scaled_size(view, options.width, options.height, view_scale(session.renderer->knobs()));
}

/// Of a frame whose picture a module may enlarge.
ViewRequest request_of(const ViewSettings& view, const Options& options) {
  return {.settings = view, .target = {.width = options.width, .height = options.height}};
}

/// Budgets judge no frame while pipelines of other settings are made in the background. However long that takes, it
/// must not use up the frames that were asked for.
void wait_for_pipelines(Renderer& renderer) {
  using Clock = std::chrono::steady_clock;
  // Where the system gives no thread for them, each frame makes one.
  constexpr std::chrono::seconds kLongest{10};
  std::size_t left = renderer.report().pipelines_pending;
  for (auto since = Clock::now(); left > 0 && Clock::now() - since < kLongest;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::size_t now = renderer.report().pipelines_pending;
    if (now < left) since = Clock::now();
    left = now;
  }
}

/// Draws a frame within the budget, if there is one. samples: the frames before it. Warns if no setting fits.
Result<FrameSample> render_in_budget(Session& session, const CommandContext& context, ShownView& shown,
                                     const std::vector<FrameSample>& samples) {
  Renderer& renderer = *session.renderer;
  if (!samples.empty()) {
    const FrameSample& last = samples.back();
    for (const BudgetDecision& told : add_frame_times(renderer, {.ms = last.wall_ms()}, last.report))
      if (told.decision.reason == GovernorReason::cannot_fit)
        context.log.warning(budget_text(told.decision, *renderer.budget(told.effect)));
    if (has_budget(context.options)) wait_for_pipelines(renderer);
  }
  set_size(session, context.options, shown.view);
  return session.render_frame(request_of(shown.drawn(), context.options));
}

Result<std::vector<FrameSample>> render_frames(Session& session, const CommandContext& context, ShownView& shown) {
  const Options& options = context.options;
  FrameRun run(session, options.in_flight);
  std::vector<FrameSample> samples;
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    if (!has_budget(options)) {
      GLOAM_TRY(run.draw(request_of(shown.drawn(), options)));
      if (frame == 0) keep_pipelines(session, options, context.log);
      continue;
    }
    auto sample = render_in_budget(session, context, shown, samples);
    if (!sample) return sample.error();
    samples.push_back(std::move(sample).value());
  }
  return has_budget(options) ? Result(std::move(samples)) : run.finish();
}

/// Draws the last frame again with the range of the colour scale that fits it.
Status fit_view(Session& session, ShownView& shown, FrameSample& last) {
  shown.fit = false;
  const auto range = fitting_heat_range(session, shown.view);
  if (!range) return range.error();
  if (*range == shown.view.heat_range) return {};
  shown.view.heat_range = *range;
  auto sample = session.render_frame({.settings = shown.view, .target = {}});
  if (!sample) return sample.error();
  last = std::move(sample).value();
  return {};
}

/// Draws the last frame again as often as the view needs to be right: until lists have room, with traced data, and with
/// a fitting colour scale.
Status settle_view(Session& session, const CommandContext& context, ShownView& shown, FrameSample& last) {
  const ViewSettings& view = shown.view;
  if (shows_lists(*session.renderer, context.options.view))
    GLOAM_TRY(draw_until_lists_fit([&] { return session.render_frame(request_of(view, context.options)); }, last));
  if (shown.traced) GLOAM_TRY(show_traced_view(session, context, *shown.traced, view, last));
  return shown.fit ? fit_view(session, shown, last) : Status();
}

/// Draws all frames, one after the other, and writes a picture of each.
Result<std::vector<FrameSample>> render_sequence(Session& session, const CommandContext& context, ShownView& shown,
                                                 const NumberedPath& path) {
  const Options& options = context.options;
  std::vector<FrameSample> samples;
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    auto sample = render_in_budget(session, context, shown, samples);
    if (!sample) return sample.error();
    samples.push_back(std::move(sample).value());
    if (frame == 0) keep_pipelines(session, options, context.log);
    GLOAM_TRY(settle_view(session, context, shown, samples.back()));
    GLOAM_TRY(write_picture(
        {.session = session, .view = shown.view, .samples = samples, .width = options.width, .height = options.height},
        path.of(frame)));
  }
  return samples;
}

}  // namespace

Status run_render(const CommandContext& context) {
  const Options& options = context.options;
  auto opened =
      context.device ? open_session_on(context.device, options, context.log) : open_session(options, context.log);
  if (!opened) return opened.error();
  Session& session = *opened.value();
  GLOAM_TRY(ensure_baked(session, options, context.log, &context.console));
  GLOAM_TRY(set_budgets(session, options, context.log));
  ShownView shown = {.view = session.view_settings(options.width, options.height, options.view),
                     .traced = traced_view(*session.renderer, options.view)};
  set_size(session, options, shown.view);
  shown.fit = fits_heat_range(session.renderer->knobs()) && shows_heat(*session.renderer, options.view);
  const std::string path = options.out.empty() ? "out/" + scene_stem(options.scene) + ".png" : options.out;
  if (path.ends_with(".exr")) session.world.set_resource(ShownLight{});
  const auto numbered = numbered_path(path);
  auto samples =
      numbered ? render_sequence(session, context, shown, *numbered) : render_frames(session, context, shown);
  if (!samples) return samples.error();
  if (!numbered) GLOAM_TRY(settle_view(session, context, shown, samples->back()));

  const DrawnRun run = {
      .session = session, .view = shown.view, .samples = *samples, .width = options.width, .height = options.height};
  if (!numbered) GLOAM_TRY(write_picture(run, path));
  GLOAM_TRY(write_reports(run, options, context.console));
  GLOAM_TRY(session.check_validation());
  if (!options.quiet) context.console.print("wrote " + path + "\n");
  return {};
}

}  // namespace gloam
