// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "engine/core/result.h"
#include "sandbox/console.h"
#include "sandbox/options.h"
#include "sandbox/output/frame_sample.h"
#include "sandbox/session/session.h"

namespace gloam {

/// What a command that drew leaves behind, as the options ask: picture, stats, trace, what lies under a pixel. view:
/// the one that was drawn, into the renderer's own image. samples: its frames, at least one.
struct DrawnRun {
  Session& session;
  const ViewSettings& view;
  std::span<const FrameSample> samples;
};

/// Writes the picture to `path` (.png: as shown, .exr: linear light), making its folder.
[[nodiscard]] Status write_picture(const DrawnRun& run, const std::string& path);

/// --stats, --trace and --pick.
[[nodiscard]] Status write_reports(const DrawnRun& run, const Options& options, Console& console);

}  // namespace gloam
