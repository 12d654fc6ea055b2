// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/core/zones.h"
#include "engine/render/renderer.h"

namespace gloam {

/// All measurements of one frame.
struct FrameSample {
  std::uint64_t begin_ns = 0;         ///< time of ZoneRecorder::now_ns
  std::uint64_t end_ns = 0;           ///< after the GPU finished the frame
  std::uint64_t previous_end_ns = 0;  ///< end_ns of the frame before it in the run; 0: none
  FrameReport report;                 ///< complete: the GPU times and counters are of this frame
  std::vector<Zone> zones;            ///< CPU zones of the frame
  /// Only of frames that were waited for on a device that is a processor (Session::render_frame): processor time of the
  /// process over the frame, divided by the cores. Other processes hardly change it.
  double processor_ms = 0.0;

  /// Time for which this was the oldest unfinished frame. With one frame in flight it is the time from begin to end.
  /// With more, it is the time from frame to frame.
  [[nodiscard]] double wall_ms() const {
    return static_cast<double>(end_ns - std::max(begin_ns, previous_end_ns)) * 1e-6;
  }
};

}  // namespace gloam
