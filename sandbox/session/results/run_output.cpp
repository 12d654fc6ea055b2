// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/run_output.h"

#include <map>

#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"
#include "sandbox/output/pictures/legend.h"
#include "sandbox/output/trace.h"
#include "sandbox/session/drawing/enlarged.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/results/stats.h"
#include "sandbox/session/results/view_values.h"

namespace gloam {
namespace {

Status write_stats(const DrawnRun& run, const Options& options) {
  const auto linear = run.session.renderer->read_linear(run.view.id);
  if (!linear) return linear.error();
  const std::map<std::string, double> counters = {{"nan_pixels", static_cast<double>(count_nan_pixels(linear->rgba))}};
  const RunDescription description = {.scene = options.scene,
                                      .device = run.session.device->info(),
                                      .width = run.view.width,
                                      .height = run.view.height,
                                      .in_flight = options.in_flight,
                                      .budgets = run.session.renderer->budgets()};
  GLOAM_TRY(make_folder_of(options.stats));
  return write_file(options.stats, stats_json(description, run.samples, counters, run.session.renderer->knobs()));
}

}  // namespace

Status write_picture(const DrawnRun& run, const std::string& path) {
  GLOAM_TRY(make_folder_of(path));
  if (path.ends_with(".exr")) {
    const auto values = read_view_values(run.session, run.view);
    if (!values) return values.error();
    return write_exr(path, values->width, values->height, values->rgba);
  }
  auto picture = run.session.renderer->read_picture(run.view.id);
  if (!picture) return picture.error();
  if (run.width > 0) *picture = enlarged(*picture, run.width, run.height);
  const std::string_view shown = std::string_view(run.view.visualizer).substr(0, run.view.visualizer.find(':'));
  std::uint32_t legend_rows = 0;
  for (const VisualizerInfo& info : run.session.renderer->visualizers())
    if (info.name == shown && shown != "none")
      legend_rows = draw_legend(*picture, info.name + ": " + info.legend, info.heat, run.view.heat_range);
  return write_png(path, picture->width, picture->height, picture->rgba, legend_rows);
}

Status write_reports(const DrawnRun& run, const Options& options, Console& console) {
  if (!options.stats.empty()) GLOAM_TRY(write_stats(run, options));
  if (!options.trace.empty()) {
    GLOAM_TRY(make_folder_of(options.trace));
    GLOAM_TRY(write_file(options.trace, chrome_trace(run.samples)));
  }
  if (options.pick) {
    // The pixel is one of the full size.
    const auto x = static_cast<std::uint32_t>(std::uint64_t{options.pick->x} * run.view.width / options.width);
    const auto y = static_cast<std::uint32_t>(std::uint64_t{options.pick->y} * run.view.height / options.height);
    const auto lines = run.session.renderer->pick(run.session.world, run.view.id, x, y);
    if (!lines) return lines.error();
    for (const std::string& line : *lines) console.print(line + "\n");
  }
  return {};
}

}  // namespace gloam
