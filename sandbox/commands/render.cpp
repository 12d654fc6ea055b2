// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <utility>
#include <vector>

#include "sandbox/commands/commands.h"
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

}  // namespace

Status run_render(const CommandContext& context) {
  const Options& options = context.options;
  auto session = open_session(options, context.log);
  if (!session) return session.error();
  warn_of_missing_effects(*session.value(), context.log);
  GLOAM_TRY(ensure_baked(*session.value(), options, context.log, &context.console));
  const ViewSettings view = session.value()->view_settings(options.width, options.height, options.view);
  const auto traced = traced_view(*session.value()->renderer, options.view);
  ViewSettings drawn = view;
  if (traced) drawn.visualizer = "none";
  auto samples = render_frames(*session.value(), options, drawn);
  if (!samples) return samples.error();
  if (shows_lists(*session.value()->renderer, options.view))
    GLOAM_TRY(draw_until_lists_fit([&] { return session.value()->render_frame({.settings = view, .target = {}}); },
                                   samples->back()));
  if (traced) GLOAM_TRY(show_traced_view(*session.value(), context, *traced, view, samples->back()));

  const DrawnRun run = {.session = *session.value(), .view = view, .samples = *samples};
  const std::string path = options.out.empty() ? "out/" + scene_stem(options.scene) + ".png" : options.out;
  GLOAM_TRY(write_picture(run, path));
  GLOAM_TRY(write_reports(run, options, context.console));
  GLOAM_TRY(session.value()->check_validation());
  if (!options.quiet) context.console.print("wrote " + path + "\n");
  return {};
}

}  // namespace gloam
