// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/zones.h"
#include "engine/render/renderer.h"

namespace gloam {

/// All measurements of one frame.
struct FrameSample {
  std::uint64_t begin_ns = 0;  ///< time of ZoneRecorder::now_ns
  std::uint64_t end_ns = 0;    ///< after the GPU finished the frame
  FrameReport report;          ///< complete: the GPU times and counters are of this frame
  std::vector<Zone> zones;     ///< CPU zones of the frame

  [[nodiscard]] double wall_ms() const { return static_cast<double>(end_ns - begin_ns) * 1e-6; }
};

}  // namespace gloam
