// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/profiler.h"
#include "engine/frame/frame_graph.h"
#include "engine/render/frame_report.h"

namespace gloam {

/// Tells the profiler of the GPU's passes that have completed since the last call, of the frame's counters and of the
/// frame's end. frame: its number.
void tell_profiler(Profiler& profiler, FrameGraph& graph, const FrameReport& report, std::uint64_t frame);

}  // namespace gloam
