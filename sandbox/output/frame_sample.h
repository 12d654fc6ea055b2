// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/zones.h"
#include "engine/render/renderer.h"

namespace gloam {

/// All that was measured of one frame.
struct FrameSample {
  std::uint64_t begin_ns = 0;  ///< on the clock of the zones
  std::uint64_t end_ns = 0;    ///< after the GPU was done with it
  FrameReport report;          ///< complete: of this very frame
  std::vector<Zone> zones;     ///< what the CPU did in it

  [[nodiscard]] double wall_ms() const { return static_cast<double>(end_ns - begin_ns) * 1e-6; }
};

}  // namespace gloam
