// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/console.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

/// A finished run, whose picture, stats, trace and pick lines can be written. view: settings of the last frame, which
/// was drawn into the renderer's own image. samples: all frames of the run, at least one.
struct DrawnRun {
  Session& session;
  const ViewSettings& view;
  std::span<const FrameSample> samples;
  std::uint32_t width = 0;  ///< of the picture as it is written; 0: as it was drawn
  std::uint32_t height = 0;
};

/// Writes the picture to `path` (.exr: read_view_values(); otherwise a PNG as shown, with the visualizer's legend) and
/// creates its folder.
[[nodiscard]] Status write_picture(const DrawnRun& run, const std::string& path);

/// Writes the results of --stats, --trace and --pick.
[[nodiscard]] Status write_reports(const DrawnRun& run, const Options& options, Console& console);

}  // namespace gloam
