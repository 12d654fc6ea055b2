// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/commands/commands.h"
#include "sandbox/output/numbered_path.h"
#include "sandbox/session/captures.h"
#include "sandbox/session/frame_run.h"
#include "sandbox/session/frame_tracing.h"
#include "sandbox/session/list_room.h"
#include "sandbox/session/run_output.h"
#include "sandbox/session/scene_loading.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

/// Traces the data that the visualizer needs and draws the last frame again with it. last: replaced by that frame.
Status show_traced_view(Session& session, const CommandContext& context, const VisualizerInfo& info,
                        const ViewSettings& view, FrameSample& last) {
  GLOAM_TRY(trace_for_view(session, info, view, context.console, context.options.quiet));
  auto sample = session.render_frame({.settings = view, .target = {}});
  if (!sample) return sample.error();
  last = std::move(sample).value();
  return {};
}

Result<std::vector<FrameSample>> render_frames(Session& session, const Options& options, const ViewSettings& view) {
  FrameRun run(session, options.in_flight);
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    GLOAM_TRY(run.draw({.settings = view, .target = {}}));
  }
  return run.finish();
}

/// Draws the last frame again as often as the view needs to be right: until lists have room, and with traced data.
Status settle_view(Session& session, const CommandContext& context, const ViewSettings& view,
                   const std::optional<VisualizerInfo>& traced, FrameSample& last) {
  if (shows_lists(*session.renderer, context.options.view))
    GLOAM_TRY(draw_until_lists_fit([&] { return session.render_frame({.settings = view, .target = {}}); }, last));
  return traced ? show_traced_view(session, context, *traced, view, last) : Status();
}

/// Draws all frames, one after the other, and writes a picture of each.
Result<std::vector<FrameSample>> render_sequence(Session& session, const CommandContext& context,
                                                 const ViewSettings& view, const ViewSettings& drawn,
                                                 const std::optional<VisualizerInfo>& traced,
                                                 const NumberedPath& path) {
  const Options& options = context.options;
  std::vector<FrameSample> samples;
  for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
    session.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    auto sample = session.render_frame({.settings = drawn, .target = {}});
    if (!sample) return sample.error();
    samples.push_back(std::move(sample).value());
    GLOAM_TRY(settle_view(session, context, view, traced, samples.back()));
    GLOAM_TRY(write_picture({.session = session, .view = view, .samples = samples}, path.of(frame)));
  }
  return samples;
}

}  // namespace

Status run_render(const CommandContext& context) {
  const Options& options = context.options;
  auto opened = open_session(options, context.log);
  if (!opened) return opened.error();
  Session& session = *opened.value();
  warn_of_missing_effects(session, context.log);
  GLOAM_TRY(ensure_baked(session, options, context.log, &context.console));
  const ViewSettings view = session.view_settings(options.width, options.height, options.view);
  const auto traced = traced_view(*session.renderer, options.view);
  ViewSettings drawn = view;
  if (traced) drawn.visualizer = "none";
  const std::string path = options.out.empty() ? "out/" + scene_stem(options.scene) + ".png" : options.out;
  const auto numbered = numbered_path(path);
  auto samples = numbered ? render_sequence(session, context, view, drawn, traced, *numbered)
                          : render_frames(session, options, drawn);
  if (!samples) return samples.error();
  if (!numbered) GLOAM_TRY(settle_view(session, context, view, traced, samples->back()));

  const DrawnRun run = {.session = session, .view = view, .samples = *samples};
  if (!numbered) GLOAM_TRY(write_picture(run, path));
  GLOAM_TRY(write_reports(run, options, context.console));
  GLOAM_TRY(session.check_validation());
  if (!options.quiet) context.console.print("wrote " + path + "\n");
  return {};
}

}  // namespace gloam
