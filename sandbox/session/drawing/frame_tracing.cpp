// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/frame_tracing.h"

#include <chrono>
#include <utility>

#include "modules/accuracy/module.h"
#include "sandbox/output/progress_bar.h"

namespace gloam {
namespace {

constexpr std::uint32_t kViewSamples = kLedgerSamples;

/// Draws a frame of a changed world, twice: what a frame takes from its predecessor is settled in the second one.
Result<FramePictures> draw_changed(Session& session, const ViewSettings& view,
                                   const std::function<void(World&)>& change,
                                   const std::function<void(World&)>& restore) {
  const auto draw = [&]() -> Result<FramePictures> {
    for (int i = 0; i < 2; ++i)
      if (const auto sample = session.render_frame({.settings = view, .target = {}}); !sample) return sample.error();
    auto linear = session.renderer->read_linear(view.id);
    if (!linear) return linear.error();
    auto picture = session.renderer->read_picture(view.id);
    if (!picture) return picture.error();
    return FramePictures{std::move(linear).value(), std::move(picture).value()};
  };
  change(session.world);
  auto pictures = draw();
  restore(session.world);
  return pictures;
}

}  // namespace

Result<FrameToTrace> read_frame_to_trace(Session& session, ViewId view) {
  auto geometry = session.renderer->read_geometry(session.world, view);
  if (!geometry) return geometry.error();
  // Rays start at visible surfaces. With the camera as the tracer's origin, floats are most precise near the camera.
  auto tracer = make_scene_tracer(session.world, *session.executor, geometry->view.position);
  if (!tracer) return tracer.error();
  return FrameToTrace{.geometry = std::move(geometry).value(), .tracer = std::move(tracer).value()};
}

std::optional<VisualizerInfo> traced_view(const Renderer& renderer, std::string_view name) {
  const std::string_view stem = name.substr(0, name.find(':'));
  for (VisualizerInfo& info : renderer.visualizers())
    if (info.name == stem && info.trace) return std::move(info);
  return std::nullopt;
}

Status check_shown_live(const Renderer& renderer, std::string_view name) {
  const auto traced = traced_view(renderer, name);
  if (!traced) return {};
  return Error{ErrorKind::usage,
               "view " + traced->name + " is traced, which takes a while: `gloam render --view` shows it"};
}

Status trace_for_view(Session& session, const VisualizerInfo& info, const ViewSettings& view, Console& console,
                      bool quiet) {
  using Clock = std::chrono::steady_clock;
  auto frame = read_frame_to_trace(session, view.id);
  if (!frame) return frame.error();
  const Clock::time_point begin = Clock::now();
  const auto show = [&](std::size_t done, std::size_t total) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - begin).count();
    console.show_progress(progress_line(done, total, "parts computed for view " + info.name, done, elapsed_s));
  };
  const FramePictures none;
  const ReferenceInput input = {.world = session.world,
                                .view = frame->geometry.view,
                                .knobs = session.renderer->knobs(),
                                .frame = none,
                                .samples = kViewSamples,
                                .executor = *session.executor,
                                .tracer = frame->tracer.get(),
                                .geometry = &frame->geometry,
                                .redraw =
                                    [&](const auto& change, const auto& restore) {
                                      ViewSettings plain = view;
                                      plain.visualizer = "none";
                                      return draw_changed(session, plain, change, restore);
                                    },
                                .progress = quiet ? std::function<void(std::size_t, std::size_t)>() : show};
  Status traced = info.trace(session.world, input);
  console.show_progress("");
  return traced;
}

}  // namespace gloam
